/* The lists that instances of this library have been created with: equal ones are in memory once. */
#include "lists.h"

#include <string.h>

#if defined(_MSC_VER)
#include <intrin.h>
static volatile long locked;
#define LOCK() while (_InterlockedExchange(&locked, 1) != 0)
#define UNLOCK() _InterlockedExchange(&locked, 0)
#else
static volatile int locked;
#define LOCK() while (__sync_lock_test_and_set(&locked, 1) != 0)
#define UNLOCK() __sync_lock_release(&locked)
#endif

static Lists *shared;

static int are_equal(const Lists *one, const Lists *other)
{
    return one->identity == other->identity && one->numbers == other->numbers
        && one->tables.axis_count == other->tables.axis_count && strcmp(one->guid, other->guid) == 0;
}

/* While it is locked, little is done: hosts may create instances in several threads. */
const Lists *axcomp_share_lists(Lists *lists)
{
    LOCK() {
    }
    Lists *found = shared;
    while (found != NULL && !are_equal(found, lists)) {
        found = found->next;
    }
    if (found == NULL) {
        lists->next = shared;
        shared = found = lists;
    }
    found->users++;
    UNLOCK();
    if (found != lists) {
        axcomp_free_lists(lists);
    }
    return found;
}

void axcomp_release_lists(const Lists *lists)
{
    Lists *unused = NULL;
    LOCK() {
    }
    for (Lists **link = &shared; *link != NULL && unused == NULL; link = unused == NULL ? &(*link)->next : link) {
        if (*link == lists && --(*link)->users == 0) {
            unused = *link;
            *link = unused->next;
        }
    }
    UNLOCK();
    axcomp_free_lists(unused);
}
