cz_test(test_documents unit test_documents.c stand_in.c)
cz_test(test_tables unit test_tables.c stand_in.c)
cz_test(test_folder errors test_folder.c stand_in.c)
cz_test(test_figures unit test_figures.c)
