/* The simple chain in MuJoCo: a slide joint for each car, semi-implicit Euler with the step of the
 * plain program, the couplers as passive forces. */
#include "bench/chain.h"

#include <math.h>
#include <stdlib.h>
#include <stdio.h>
#include <string.h>
#include <mujoco/mujoco.h>

typedef struct Mujoco {
    int n;
    mjModel *model;
    mjData *data;
    double set[CHAIN_MAX_CARS]; /* permanent set of each coupler [m] */
    ChainResult *result;
} Mujoco;

/* The chain whose step MuJoCo makes: its callback gets nothing of the caller's. */
static Mujoco *stepped;

static void couplers(const mjModel *model, mjData *data) {
    Mujoco *chain = stepped;
    (void)model;
    for (int i = 0; i < chain->n - 1; i++) {
        const Coupler *coupler = chain_coupler(chain->n, i);
        const double shortening = data->qpos[i] - data->qpos[i + 1];
        const double force = chain_force(coupler, shortening, chain->set[i]);
        chain->set[i] = chain_next_set(coupler, shortening, chain->set[i], force);
        data->qfrc_passive[i] -= force;
        data->qfrc_passive[i + 1] += force;
        chain->result->force[i] = fmax(chain->result->force[i], force);
        chain->result->shortening[i] = fmax(chain->result->shortening[i], shortening);
    }
}

static int write_model(char *text, size_t room, int n) {
    int used = snprintf(text, room,
                        "<mujoco><option timestep=\"%g\" gravity=\"0 0 0\" integrator=\"Euler\">"
                        "<flag contact=\"disable\" constraint=\"disable\"/></option><worldbody>",
                        CHAIN_STEP);
    for (int i = 0; i < n; i++)
        used += snprintf(text + used, room - (size_t)used,
                         "<body><joint type=\"slide\" axis=\"1 0 0\"/>"
                         "<inertial pos=\"0 0 0\" mass=\"%g\" diaginertia=\"1e5 1e5 1e5\"/></body>",
                         CHAIN_MASS);
    return used + snprintf(text + used, room - (size_t)used, "</worldbody></mujoco>");
}

static void *create(int n) {
    char text[16384], message[1000] = "";
    const int used = write_model(text, sizeof text, n);
    mjVFS *files = malloc(sizeof *files); /* in memory: a virtual folder with the model */
    Mujoco *chain = calloc(1, sizeof *chain);
    if (files == NULL || chain == NULL)
        return NULL;
    mj_defaultVFS(files);
    mj_makeEmptyFileVFS(files, "chain.xml", used + 1);
    memcpy(files->filedata[0], text, (size_t)used + 1);
    chain->n = n;
    chain->model = mj_loadXML("chain.xml", files, message, sizeof message);
    mj_deleteVFS(files);
    free(files);
    if (chain->model == NULL) {
        fprintf(stderr, "bench: MuJoCo: %s\n", message);
        free(chain);
        return NULL;
    }
    chain->data = mj_makeData(chain->model);
    return chain;
}

static void run(void *model, ChainResult *result) {
    Mujoco *chain = model;
    mj_resetData(chain->model, chain->data);
    memset(chain->set, 0, sizeof chain->set);
    memset(result, 0, sizeof *result);
    chain->result = result;
    for (int i = 0; i < chain->n / 2; i++)
        chain->data->qvel[i] = CHAIN_SPEED;
    stepped = chain;
    mjcb_passive = couplers;
    const long n_step = lround(CHAIN_DURATION / CHAIN_STEP);
    for (long k = 0; k < n_step; k++)
        mj_step(chain->model, chain->data);
    mjcb_passive = NULL;
    memcpy(result->speed, chain->data->qvel, (size_t)chain->n * sizeof *result->speed);
}

static void destroy(void *model) {
    Mujoco *chain = model;
    mj_deleteData(chain->data);
    mj_deleteModel(chain->model);
    free(chain);
}

const ChainPeer chain_mujoco = {.name = "MuJoCo",
                                .method = "Euler, 0.1 ms",
                                .version = mj_versionString,
                                .create = create,
                                .run = run,
                                .destroy = destroy};
