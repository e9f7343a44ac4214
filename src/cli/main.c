/* The program crushzone. */
#include "cli/program.h"

int main(int argc, char **argv) {
    return cz_program(argc, argv, NULL);
}
