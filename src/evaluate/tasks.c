/* Independent tasks on a few threads. */
#include "evaluate/tasks.h"

#include <pthread.h>
#include <stdatomic.h>
#include <unistd.h>

enum { MOST_THREADS = 64 };

typedef struct Queue {
    atomic_int next;
    int n_task;
    CzTaskFunction function;
    void *data;
    pthread_mutex_t lock; /* protects the following members */
    int failed;           /* first task that failed; n_task when none did */
    CzStatus status;
    CzError *error; /* NULL when not requested */
} Queue;

static void note_failure(Queue *queue, int index, CzStatus status, const CzError *error) {
    pthread_mutex_lock(&queue->lock);
    if (index < queue->failed) {
        queue->failed = index;
        queue->status = status;
        if (queue->error != NULL)
            *queue->error = *error;
    }
    pthread_mutex_unlock(&queue->lock);
}

static void *work(void *argument) {
    Queue *queue = argument;
    for (;;) {
        CzError error = {0};
        const int index = atomic_fetch_add(&queue->next, 1);
        if (index >= queue->n_task)
            return NULL;
        const CzStatus status = queue->function(index, queue->data, &error);
        if (status != CZ_OK)
            note_failure(queue, index, status, &error);
    }
}

CzStatus cz_tasks_run(int n_task, int n_job, CzTaskFunction function, void *data, CzError *error) {
    Queue queue = {.n_task = n_task,
                   .function = function,
                   .data = data,
                   .lock = PTHREAD_MUTEX_INITIALIZER,
                   .failed = n_task,
                   .status = CZ_OK,
                   .error = error};
    atomic_init(&queue.next, 0);
    pthread_t thread[MOST_THREADS];
    int n_thread = 0;
    const int n_wanted = (n_job < n_task ? n_job : n_task) - 1;
    while (n_thread < n_wanted && n_thread < MOST_THREADS &&
           pthread_create(&thread[n_thread], NULL, work, &queue) == 0)
        n_thread++;
    work(&queue);
    for (int i = 0; i < n_thread; i++)
        pthread_join(thread[i], NULL);
    return queue.status;
}

int cz_processor_count(void) {
    const long n = sysconf(_SC_NPROCESSORS_ONLN);
    return n < 1 ? 1 : (int)n;
}
