if(CZ_IS_WHOLE)
    # The rows of tests/physics as a page; page.sh runs it and compares.
    cz_program(verification verification.c tests/physics/closed_forms.c tests/physics/published.c
               tests/physics/rails.c
               tests/physics/scheme.c tests/physics/steps.c)
    cz_build_for(runs verification)
    cz_script(verification_page runs page.sh)
    # A second page: costs and differences of the track models.
    cz_program(tracks tracks.c)
    cz_build_for(runs tracks)
    cz_script(track_page runs track.sh)
endif()
