/* Batches of tasks, and the executors of this process: one after another, and threads. */
#include "evaluate/tasks.h"
#include "base/error.h"

#include <pthread.h>
#include <stdatomic.h>
#include <stdlib.h>
#include <unistd.h>

enum { MAX_THREADS = 64 };

struct CzTasks {
    int n;
    CzTaskFunction function;
    const CzTaskData *plain; /* NULL for tasks of this process alone */
    void *data;
    atomic_int next; /* the first task that no thread has taken */
    pthread_t thread[MAX_THREADS];
    int n_thread;
    pthread_mutex_t lock; /* protects the following members */
    int failed;           /* first task that failed; n when none did */
    CzStatus status;
    CzError *error; /* NULL when not requested */
};

int cz_tasks_n(const CzTasks *tasks) {
    return tasks->n;
}

static void note_failure(CzTasks *tasks, int index, CzStatus status, const CzError *error) {
    pthread_mutex_lock(&tasks->lock);
    if (index < tasks->failed) {
        tasks->failed = index;
        tasks->status = status;
        if (tasks->error != NULL)
            *tasks->error = *error;
    }
    pthread_mutex_unlock(&tasks->lock);
}

void cz_task_run(CzTasks *tasks, int task) {
    CzError error = {0};
    const CzStatus status = tasks->function(task, tasks->data, &error);
    if (status != CZ_OK)
        note_failure(tasks, task, status, &error);
}

static CzStatus run(const CzExecutor *executor, const CzTaskData *plain, int n_task,
                    CzTaskFunction function, void *data, CzError *error) {
    CzTasks tasks = {.n = n_task,
                     .function = function,
                     .plain = plain,
                     .data = data,
                     .lock = PTHREAD_MUTEX_INITIALIZER,
                     .failed = n_task,
                     .status = CZ_OK,
                     .error = error};
    atomic_init(&tasks.next, 0);
    CZ_TRY(executor->submit(executor, &tasks, error));
    CZ_TRY(executor->wait(executor, &tasks, error));
    return tasks.status;
}

CzStatus cz_tasks_run(const CzExecutor *executor, int n_task, CzTaskFunction function, void *data,
                      CzError *error) {
    return run(executor, NULL, n_task, function, data, error);
}

/* ---- tasks as plain data --------------------------------------------------------------------- */

CzStatus cz_tasks_share(const CzTaskData *plain, int n_task, CzTaskFunction function, void *data,
                        CzError *error) {
    CZ_TRY(cz_study_begin(plain->study, error));
    return run(&plain->study->executor, plain->study->is_known ? plain : NULL, n_task, function,
               data, error);
}

void cz_bytes_free(CzBytes *bytes) {
    free(bytes->byte);
    *bytes = (CzBytes){0};
}

bool cz_task_request(CzTasks *tasks, int task, CzBytes *request) {
    CzMemoryText text = {0};
    bool is_made = tasks->plain != NULL;
    if (is_made) {
        cz_study_put(&text, tasks->plain->study);
        is_made = tasks->plain->request(task, tasks->data, &text) && !text.failed;
    }
    *request = (CzBytes){.n = text.n, .byte = text.text};
    if (!is_made)
        cz_bytes_free(request);
    return is_made;
}

void cz_task_take(CzTasks *tasks, int task, const CzBytes *answer) {
    CzReading reading = {.next = answer->byte, .n_left = answer->n};
    CzError error = {0};
    CzStatus status = (CzStatus)cz_get_int(&reading);
    if (reading.has_ended)
        status = cz_no_memory(&error, "the results of a task");
    if ((int)status == CZ_RUN_HERE) {
        cz_task_run(tasks, task);
        return;
    }
    if (status == CZ_OK)
        status = tasks->plain->take(task, tasks->data, &reading, &error);
    else if (!reading.has_ended)
        cz_get(&reading, &error, 1, sizeof error);
    if (status != CZ_OK)
        note_failure(tasks, task, status, &error);
}

/* ---- threads --------------------------------------------------------------------------------- */

static void *work(void *argument) {
    CzTasks *tasks = argument;
    for (int task; (task = atomic_fetch_add(&tasks->next, 1)) < tasks->n;)
        cz_task_run(tasks, task);
    return NULL;
}

static CzStatus start_threads(const CzExecutor *executor, CzTasks *tasks, CzError *error) {
    const int n_place = executor->n_place;
    const int n_wanted = (n_place < tasks->n ? n_place : tasks->n) - 1;
    (void)error;
    while (tasks->n_thread < n_wanted && tasks->n_thread < MAX_THREADS &&
           pthread_create(&tasks->thread[tasks->n_thread], NULL, work, tasks) == 0)
        tasks->n_thread++;
    return CZ_OK;
}

static CzStatus end_threads(const CzExecutor *executor, CzTasks *tasks, CzError *error) {
    (void)executor;
    (void)error;
    work(tasks);
    for (int i = 0; i < tasks->n_thread; i++)
        pthread_join(tasks->thread[i], NULL);
    return CZ_OK;
}

int cz_processor_count(void) {
    const long n = sysconf(_SC_NPROCESSORS_ONLN);
    return n < 1 ? 1 : (int)n;
}

CzExecutor cz_executor_threads(int n_thread) {
    return (CzExecutor){.n_place = n_thread > 0 ? n_thread : cz_processor_count(),
                        .submit = start_threads,
                        .wait = end_threads};
}

CzExecutor cz_executor_none(void) {
    return cz_executor_threads(1);
}

CzExecutor cz_executor_choose(const CzExecutor *given, int n_job) {
    return given != NULL ? *given : cz_executor_threads(n_job);
}

CzStatus cz_tasks_cut(int n, const char *what, int shard, int n_shard, int *begin, int *end,
                      CzError *error) {
    const long long all = n, of = n_shard;
    if (of < 1 || shard < 1 || shard > of || of > all)
        return cz_fail(error, CZ_STATUS_INPUT,
                       "there is no shard %d of %d of %d %s" CZ_HELP
                       "shards count from 1 to their number, which is at most that of the %s",
                       shard, n_shard, n, what, what);
    *begin = (int)((shard - 1) * all / of);
    *end = (int)(shard * all / of);
    return CZ_OK;
}
