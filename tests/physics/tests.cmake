if(CZ_IS_WHOLE)
    cz_test(test_energy_sum physics test_energy_sum.c)
    cz_test(test_closed_forms physics test_closed_forms.c)
endif()
