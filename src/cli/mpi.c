/* The program crushzone-mpi: rank 0 runs the command, the other ranks are its workers. The one file
 * that includes mpi.h.
 *
 *   rank 0 --message--> ranks 1, 2 --> ranks 3 to 6 --> ...   what a study is
 *   rank 0 --request--> rank r --answer--> rank 0             a task
 *
 * Messages pass from rank to rank, so that rank 0 sends them twice and not to thousands. A request
 * says how many messages were sent before it, and its rank receives these first.
 */
#include <limits.h>
#include <mpi.h>
#include <signal.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "base/clock.h"
#include "cli/program.h"

enum { TAG_MESSAGE, TAG_REQUEST, TAG_ANSWER };

enum { MAX_OPEN = 2 }; /* requests of a rank without an answer: one runs, the next one waits */

/* Head of requests and answers. */
typedef struct Head {
    int64_t n_message; /* that were sent before the request */
    int64_t task;
    double time; /* of an answer: processor time of the task [s] */
} Head;

/* Waits without use of the processor, which another rank may need. */
static void wait_shortly(void) {
    const struct timespec time = {.tv_nsec = 50000};
    nanosleep(&time, NULL);
}

/* ---- packets --------------------------------------------------------------------------------- */

/* Bytes behind a head, as they are sent. */
typedef struct Packet {
    int n;
    char *byte; /* (n); NULL without memory */
} Packet;

static Packet pack(Head head, const CzBytes *bytes) {
    Packet packet = {0};
    if (bytes->n > INT_MAX - sizeof head)
        return packet;
    packet.n = (int)(sizeof head + bytes->n);
    packet.byte = malloc((size_t)packet.n);
    if (packet.byte == NULL)
        return packet;
    memcpy(packet.byte, &head, sizeof head);
    if (bytes->n > 0)
        memcpy(packet.byte + sizeof head, bytes->byte, bytes->n);
    return packet;
}

static CzBytes bytes_of(const Packet *packet) {
    return (CzBytes){.n = (size_t)packet->n - sizeof(Head), .byte = packet->byte + sizeof(Head)};
}

/* Receives a packet that has arrived; a rank without memory for it ends the job. */
static Packet receive(const MPI_Status *arrived) {
    Packet packet;
    MPI_Get_count(arrived, MPI_BYTE, &packet.n);
    packet.byte = malloc((size_t)packet.n + 1);
    if (packet.byte == NULL)
        MPI_Abort(MPI_COMM_WORLD, cz_status_exit_code(CZ_STATUS_NO_MEMORY));
    MPI_Recv(packet.byte, packet.n, MPI_BYTE, arrived->MPI_SOURCE, arrived->MPI_TAG, MPI_COMM_WORLD,
             MPI_STATUS_IGNORE);
    return packet;
}

/* Sends a packet on to the ranks behind this one. */
static void pass_on(const Packet *packet, int rank, int n_rank) {
    for (int next = 2 * rank + 1; next <= 2 * rank + 2 && next < n_rank; next++)
        MPI_Send(packet->byte, packet->n, MPI_BYTE, next, TAG_MESSAGE, MPI_COMM_WORLD);
}

/* ---- batches as scripts/schedule-ranks reads them ---------------------------------------------
 */

/* Times are those of the processor, which other work does not lengthen. */
typedef struct Batches {
    FILE *stream; /* of the file in the environment variable CRUSHZONE_BATCHES; NULL: none */
    double began, ended;
    int n_task, n_answer;
    double in_tasks, alone; /* of all ranks; of this one before the batch [s] */
    double n_byte;          /* of answers */
} Batches;

static Batches begin_batches(void) {
    const char *path = getenv("CRUSHZONE_BATCHES");
    Batches batches = {.stream = path != NULL ? fopen(path, "w") : NULL, .began = cz_clock()};
    if (batches.stream != NULL)
        fputs("# how often, tasks, a task [ms], its answer [kB], rank 0 alone [ms]\n",
              batches.stream);
    return batches;
}

static void begin_batch(Batches *batches, int n_task) {
    batches->n_task = n_task;
    batches->n_answer = 0;
    batches->in_tasks = batches->n_byte = 0;
    batches->alone = batches->stream != NULL ? cz_processor_clock() - batches->ended : 0;
}

static void run_here(Batches *batches, CzTasks *tasks, int task) {
    const double began = batches->stream != NULL ? cz_processor_clock() : 0;
    cz_task_run(tasks, task);
    batches->in_tasks += batches->stream != NULL ? cz_processor_clock() - began : 0;
}

static void end_batch(Batches *batches) {
    if (batches->stream == NULL)
        return;
    fprintf(batches->stream, "1 %d %.4f %.2f %.4f batch\n", batches->n_task,
            batches->n_task > 0 ? 1e3 * batches->in_tasks / batches->n_task : 0,
            batches->n_answer > 0 ? 1e-3 * batches->n_byte / batches->n_answer : 0,
            1e3 * batches->alone);
    batches->ended = cz_processor_clock();
}

static void end_batches(Batches *batches) {
    if (batches->stream == NULL)
        return;
    begin_batch(batches, 0);
    end_batch(batches);
    fprintf(batches->stream, "# measured %.3f s\n", cz_clock() - batches->began);
    fclose(batches->stream);
}

/* ---- rank 0 ---------------------------------------------------------------------------------- */

/* A request that was sent. */
typedef struct Sent {
    MPI_Request request;
    Packet packet; /* without bytes: nothing is sent */
    int64_t task;
} Sent;

/* The workers, and the batch that they run. */
typedef struct Ranks {
    int n; /* ranks, this one among them */
    int64_t n_message;
    Sent (*sent)[MAX_OPEN]; /* (n) */
    int n_left;             /* tasks of the batch that nobody has yet */
    int n_open;             /* tasks that other ranks have */
    Batches batches;
} Ranks;

static CzStatus broadcast(const CzExecutor *executor, const CzBytes *message, CzError *error) {
    Ranks *ranks = executor->data;
    Packet packet = pack((Head){0}, message);
    (void)error;
    if (packet.byte == NULL)
        MPI_Abort(MPI_COMM_WORLD, cz_status_exit_code(CZ_STATUS_NO_MEMORY));
    pass_on(&packet, 0, ranks->n);
    ranks->n_message++;
    free(packet.byte);
    return CZ_OK;
}

static int next_task(Ranks *ranks, const CzTasks *tasks) {
    return cz_tasks_n(tasks) - ranks->n_left--;
}

/* Sends the next task to a rank, or runs it here where it is not for workers. */
static void hand_out(Ranks *ranks, CzTasks *tasks, int rank, Sent *sent) {
    CzBytes request;
    const int task = next_task(ranks, tasks);
    bool is_request = cz_task_request(tasks, task, &request);
    if (is_request) {
        sent->packet = pack((Head){.n_message = ranks->n_message, .task = task}, &request);
        sent->task = task;
        is_request = sent->packet.byte != NULL;
        cz_bytes_free(&request);
    }
    if (!is_request) {
        run_here(&ranks->batches, tasks, task);
        return;
    }
    ranks->n_open++;
    MPI_Isend(sent->packet.byte, sent->packet.n, MPI_BYTE, rank, TAG_REQUEST, MPI_COMM_WORLD,
              &sent->request);
}

/* Gives every rank a task, and a second one while many are left. */
static void hand_out_all(Ranks *ranks, CzTasks *tasks) {
    for (int k = 0; k < MAX_OPEN; k++)
        for (int rank = 1; rank < ranks->n && ranks->n_left > k * 2 * ranks->n; rank++)
            if (ranks->sent[rank][k].packet.byte == NULL)
                hand_out(ranks, tasks, rank, &ranks->sent[rank][k]);
}

/* Takes an answer that has arrived. */
static void take(Ranks *ranks, CzTasks *tasks, const MPI_Status *arrived) {
    Packet packet = receive(arrived);
    const CzBytes answer = bytes_of(&packet);
    Head head;
    memcpy(&head, packet.byte, sizeof head);
    for (int k = 0; k < MAX_OPEN; k++) {
        Sent *sent = &ranks->sent[arrived->MPI_SOURCE][k];
        if (sent->packet.byte == NULL || sent->task != head.task)
            continue;
        MPI_Wait(&sent->request, MPI_STATUS_IGNORE); /* it was received, as there is an answer */
        free(sent->packet.byte);
        sent->packet.byte = NULL;
    }
    ranks->n_open--;
    ranks->batches.n_answer++;
    ranks->batches.n_byte += packet.n;
    ranks->batches.in_tasks += head.time;
    cz_task_take(tasks, (int)head.task, &answer);
    free(packet.byte);
}

static CzStatus submit(const CzExecutor *executor, CzTasks *tasks, CzError *error) {
    Ranks *ranks = executor->data;
    (void)error;
    ranks->n_left = cz_tasks_n(tasks);
    begin_batch(&ranks->batches, ranks->n_left);
    hand_out_all(ranks, tasks);
    return CZ_OK;
}

/* Answers come first, then requests; where there is neither, this rank runs a task. */
static CzStatus wait_for_all(const CzExecutor *executor, CzTasks *tasks, CzError *error) {
    Ranks *ranks = executor->data;
    (void)error;
    while (ranks->n_left + ranks->n_open > 0) {
        int is_there;
        MPI_Status arrived;
        MPI_Iprobe(MPI_ANY_SOURCE, TAG_ANSWER, MPI_COMM_WORLD, &is_there, &arrived);
        if (is_there) {
            take(ranks, tasks, &arrived);
            hand_out_all(ranks, tasks);
        } else if (ranks->n_left > 0) {
            run_here(&ranks->batches, tasks, next_task(ranks, tasks));
        } else {
            wait_shortly();
        }
    }
    end_batch(&ranks->batches);
    return CZ_OK;
}

static int run_command(int argc, char **argv, int n_rank) {
    Ranks ranks = {.n = n_rank,
                   .sent = calloc((size_t)n_rank, sizeof *ranks.sent),
                   .batches = begin_batches()};
    const CzExecutor executor = {.n_place = n_rank,
                                 .submit = submit,
                                 .wait = wait_for_all,
                                 .broadcast = n_rank > 1 ? broadcast : NULL,
                                 .data = &ranks};
    if (ranks.sent == NULL)
        MPI_Abort(MPI_COMM_WORLD, cz_status_exit_code(CZ_STATUS_NO_MEMORY));
    const int code = cz_program(argc, argv, &executor);
    const CzBytes end = {0};
    (void)broadcast(&executor, &end, NULL);
    end_batches(&ranks.batches);
    free(ranks.sent);
    return code;
}

/* ---- other ranks ----------------------------------------------------------------------------- */

typedef struct Follower {
    int rank, n_rank;
    int64_t n_message; /* that were received */
    bool is_ending;
    CzWorker *worker;
    MPI_Request sending; /* of the last answer */
    Packet answer;
} Follower;

/* Takes the next message, which comes from the rank before this one; an empty one is the end. */
static void take_message(Follower *own) {
    MPI_Status arrived;
    MPI_Probe((own->rank - 1) / 2, TAG_MESSAGE, MPI_COMM_WORLD, &arrived);
    Packet packet = receive(&arrived);
    const CzBytes message = bytes_of(&packet);
    pass_on(&packet, own->rank, own->n_rank);
    own->n_message++;
    own->is_ending = message.n == 0;
    if (!own->is_ending)
        cz_worker_receive(own->worker, &message);
    free(packet.byte);
}

static void end_sending(Follower *own) {
    if (own->answer.byte == NULL)
        return;
    MPI_Wait(&own->sending, MPI_STATUS_IGNORE);
    free(own->answer.byte);
    own->answer.byte = NULL;
}

/* Runs the task of a request; its answer is sent while the next one runs. */
static void answer(Follower *own, const MPI_Status *arrived) {
    Packet packet = receive(arrived);
    const CzBytes request = bytes_of(&packet);
    CzBytes made = {0};
    Head head;
    memcpy(&head, packet.byte, sizeof head);
    while (own->n_message < head.n_message)
        take_message(own);
    const double began = cz_processor_clock();
    const CzStatus status = cz_worker_answer(own->worker, &request, &made);
    head.time = cz_processor_clock() - began;
    end_sending(own);
    if (status == CZ_OK)
        own->answer = pack(head, &made);
    if (own->answer.byte == NULL)
        MPI_Abort(MPI_COMM_WORLD, cz_status_exit_code(CZ_STATUS_NO_MEMORY));
    MPI_Isend(own->answer.byte, own->answer.n, MPI_BYTE, 0, TAG_ANSWER, MPI_COMM_WORLD,
              &own->sending);
    cz_bytes_free(&made);
    free(packet.byte);
}

static void follow(int rank, int n_rank) {
    Follower own = {.rank = rank, .n_rank = n_rank, .worker = cz_worker_create()};
    signal(SIGINT, SIG_IGN); /* rank 0 ends the job */
    signal(SIGTERM, SIG_IGN);
    if (own.worker == NULL)
        MPI_Abort(MPI_COMM_WORLD, cz_status_exit_code(CZ_STATUS_NO_MEMORY));
    while (!own.is_ending) {
        int is_there;
        MPI_Status arrived;
        MPI_Iprobe(MPI_ANY_SOURCE, MPI_ANY_TAG, MPI_COMM_WORLD, &is_there, &arrived);
        if (!is_there)
            wait_shortly();
        else if (arrived.MPI_TAG == TAG_MESSAGE)
            take_message(&own);
        else
            answer(&own, &arrived);
    }
    end_sending(&own);
    cz_worker_free(own.worker);
}

int main(int argc, char **argv) {
    int rank, n_rank, code = 0;
    MPI_Init(&argc, &argv);
    MPI_Comm_rank(MPI_COMM_WORLD, &rank);
    MPI_Comm_size(MPI_COMM_WORLD, &n_rank);
    if (rank == 0)
        code = run_command(argc, argv, n_rank);
    else
        follow(rank, n_rank);
    MPI_Finalize();
    return code;
}
