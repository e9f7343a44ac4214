# cmake -DIN=file -DNAME=name -DHEADER=declares-it.h -DOUT=file.c [-DHASH=name] -P embed.cmake: writes a text file as the C
# string `name`, and its SHA-256 in base 64, as a content security policy has it, as the C string HASH.
file(READ "${IN}" text)
string(REPLACE "\\" "\\\\" text "${text}")
string(REPLACE "\"" "\\\"" text "${text}")
string(REPLACE "\n" "\\n\"\n    \"" text "${text}")
get_filename_component(from "${IN}" NAME)
file(WRITE "${OUT}" "/* ${from} as a text. */\n#include \"${HEADER}\"\n\nconst char ${NAME}[] =\n    \"${text}\";\n")

if(HASH)
    set(letters "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/")
    file(SHA256 "${IN}" digits)
    string(APPEND digits "00") # to a multiple of three
    set(base64 "")
    foreach(at RANGE 0 63 3) # three digits are two letters
        string(SUBSTRING "${digits}" ${at} 3 three)
        math(EXPR first "0x${three} >> 6")
        math(EXPR second "0x${three} & 63")
        string(SUBSTRING "${letters}" ${first} 1 first)
        string(SUBSTRING "${letters}" ${second} 1 second)
        string(APPEND base64 "${first}${second}")
    endforeach()
    string(REGEX REPLACE "A$" "=" base64 "${base64}")
    file(APPEND "${OUT}" "const char ${HASH}[] = \"${base64}\";\n")
endif()
