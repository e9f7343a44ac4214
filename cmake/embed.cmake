# cmake -DIN=file -DNAME=name -DHEADER=declares-it.h -DOUT=file.c -P embed.cmake: writes a text file as the C string `name`.
file(READ "${IN}" text)
string(REPLACE "\\" "\\\\" text "${text}")
string(REPLACE "\"" "\\\"" text "${text}")
string(REPLACE "\n" "\\n\"\n    \"" text "${text}")
get_filename_component(from "${IN}" NAME)
file(WRITE "${OUT}" "/* ${from} as a text. */\n#include \"${HEADER}\"\n\nconst char ${NAME}[] =\n    \"${text}\";\n")
