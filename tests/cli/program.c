/* The program as a function, for tests that run it many times over. */
#define main program_main
int program_main(int argc, char **argv);
#include "cli/main.c"
