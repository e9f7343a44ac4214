/* Published numbers of vehicles and of full-scale tests, as rows. */
#ifndef CZ_TESTS_PHYSICS_PUBLISHED_H
#define CZ_TESTS_PHYSICS_PUBLISHED_H

#include "physics/rows.h"

/* Frequencies and axle loads of two published coaches. */
void rows_of_coaches(Rows *rows);

/* A longitudinal force above or below the centre of gravity loads the bogies unequally. */
void rows_of_pitch_by_force(Rows *rows);

/* The same force applied suddenly: twice the static pitch. */
void rows_of_step_force(Rows *rows);

/* Full-scale tests of which masses, speeds and crush are published, but no curve. */
void rows_of_train_to_train(Rows *rows);
void rows_of_crush_of_single_cars(Rows *rows);
void rows_of_coupling_speeds(Rows *rows);
void rows_of_eight_car_trains(Rows *rows);

#endif
