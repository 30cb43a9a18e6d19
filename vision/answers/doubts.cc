#include "vision/answers/doubts.h"

#include "vision/answers/answers.h"

static const int64_t period = 900000; /* us */
static const int least_pairs = 8;
static const double most_share = 0.8; /* of the pairs: no chance */

static bool most(const doubts &all, int n)
{
    return n >= most_share * all.pairs;
}

static const char *judge(const doubts &all)
{
    const bool left = most(all, all.still_left);
    const bool right = most(all, all.still_right);

    if (all.pairs < least_pairs)
        return nullptr;
    /* Both at once can be a simulated robot at rest. */
    if (left != right)
        return left ? "the left eye's pictures do not change: its camera or driver hangs"
                    : "the right eye's pictures do not change: its camera or driver hangs";
    if (most(all, all.behind))
        return "the lines of sight meet behind the eyes: left and right are swapped, or "
               "eyes.vergence is wrong";
    if (most(all, all.heights))
        return "the eyes see the ball at different heights: one eye's pictures are late, or the "
               "rig "
               "is not as configured (reach-vision --calibrate)";
    return nullptr;
}

/* Returns 1 when the content is that of the pair before. */
static int same_as_before(uint64_t *known, uint64_t content)
{
    const int same = *known == content;

    *known = content;
    return same;
}

const char *doubts_add(doubts *all, const image_message &pair, const stereo_marker &marker)
{
    const char *doubt = nullptr;

    if (all->pairs > 0 && pair.utime - all->since >= period) {
        doubt = judge(*all);
        all->pairs = all->behind = all->heights = all->still_left = all->still_right = 0;
    }
    if (all->pairs == 0 || pair.utime < all->since)
        all->since = pair.utime;
    all->pairs++;
    all->behind += marker.meets_behind;
    all->heights += marker.reason == STEREO_HEIGHTS_DIFFER;
    all->still_left += same_as_before(&all->content_left, answers_content_of(pair.left));
    all->still_right += same_as_before(&all->content_right, answers_content_of(pair.right));
    return doubt;
}
