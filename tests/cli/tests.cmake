add_executable(read_json ${CMAKE_CURRENT_LIST_DIR}/read_json.c)
target_link_libraries(read_json PRIVATE cz_flags PkgConfig::JANSSON)
cz_test(test_arguments cli test_arguments.c src/cli/arguments.c)
if(CZ_IS_WHOLE)
    cz_script(cli_commands cli commands.sh) # words of cli.sh
    cz_script(cli_input cli input.sh)
    cz_script(cli_output cli output.sh)
    cz_script(cli_optimise cli optimise.sh)
endif()
