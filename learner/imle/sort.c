/* Heap sort of indices: no memory, no worst case. */
#include "learner/imle/imle.h"

/* Index a comes before b: by key, then by age. */
static bool before(const double *key, int a, int b)
{
    return key[a] < key[b] || (a < b && key[a] <= key[b]);
}

static void swap(int *a, int *b)
{
    int kept = *a;

    *a = *b;
    *b = kept;
}

static void sift_down(const double *key, int *index, int root, int n)
{
    for (int child = 2 * root + 1; child < n; child = 2 * root + 1) {
        if (child + 1 < n && before(key, index[child], index[child + 1]))
            child++;
        if (!before(key, index[root], index[child]))
            return;
        swap(&index[root], &index[child]);
        root = child;
    }
}

void imle_sort_by(const double *key, int *index, int n)
{
    for (int root = n / 2 - 1; root >= 0; root--)
        sift_down(key, index, root, n);
    for (int end = n - 1; end > 0; end--) {
        swap(&index[0], &index[end]);
        sift_down(key, index, 0, end);
    }
}
