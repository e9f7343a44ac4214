cz_test(test_documents unit test_documents.c stand_in.c)
cz_test(test_spreadsheet unit test_spreadsheet.c stand_in.c)
cz_test(test_tables unit test_tables.c stand_in.c)
cz_test(test_folder errors test_folder.c stand_in.c)
cz_test(test_figures unit test_figures.c)
cz_test(test_verification unit test_verification.c stand_in.c)
cz_test(test_page errors test_page.c)
target_link_options(test_page PRIVATE
    -Wl,--wrap=malloc,--wrap=calloc,--wrap=realloc,--wrap=aligned_alloc)
