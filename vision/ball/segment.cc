#include "vision/ball/segment.h"

#include <algorithm>
#include <cmath>

#include "vision/ball/circles.h"
#include "vision/ball/edges.h"
#include "vision/ball/judge.h"
#include "vision/ball/vote.h"

static const int fine_rounds = 2;
static const int stretched_rounds = 3;
static const double stretch_share = 0.12;   /* of the radius: edges so near belong to the ball */
static const double coarse_tolerance = 2;   /* px: edges to the pixel, and ragged ones */
static const double coarse_share = 0.5;     /* of coverage_min: less is not worth a close look */
static const double coarse_relative = 0.02; /* of the radius, where that is more */
static const double fine_tolerance = 1.5;   /* px */
static const double fine_relative = 0.014;
static const double trim_tolerance = 0.35; /* px: closer than this no edge point is left out */
static const double trim_relative = 0.0032;
static const int edge_margin = 12;        /* px around a piece: its rim can have lost its colour */
static const double plausible_share = 3;  /* of radius_max: clutter can join the ball */
static const double speck = 60;           /* px^2: less of the colour is noise */
static const double better = 1.1;         /* times the score: a second look must be worth it */
static const double reach_of_piece = 1.5; /* times its longer side: prints part a ball */

/* What segment_find works on. */
struct scene_part {
    segmenter *work;
    const image_view &image;
    const camera &eye;
    radius_range radii;
};

/* From an outline known to the pixel to one known to a fraction; `refine` is one of outline_refine
 * and outline_refine_stretched. */
static bool sharpen(const scene_part &part, decltype(outline_refine) refine, int rounds,
                    outline *cone, outline_points *points)
{
    const double focal = part.eye.focal;

    for (int round = 0; round < rounds; round++) {
        const double radius = cone->tangent * focal;
        if (!(cone->axis.z > 0.1) || radius > 2 * part.radii.most)
            return false;
        edges_fine(part.image, part.work->colours, part.eye, *cone, points);
        if (!refine(*points, focal, std::max(fine_tolerance, fine_relative * radius),
                    std::max(trim_tolerance, trim_relative * radius), cone))
            return false;
    }
    return true;
}

static bool worth_sharpening(const scene_part &part, const outline &cone)
{
    return cone.support >= coarse_share * part.work->limits.coverage_min * OUTLINE_RAYS;
}

/* The quick look, right for a ball that stands free: rays end where its colour first ends. */
static blob_fault look_quickly(const scene_part &part, const mask_piece &piece, blob *found)
{
    const double focal = part.eye.focal;
    outline_points points;

    edges_coarse(part.image, part.work->colours, part.eye, piece.centre,
                 std::max(piece.width, piece.height), &points);
    if (!outline_consensus(points, focal, coarse_tolerance, &found->cone) ||
        !worth_sharpening(part, found->cone) ||
        !outline_refine(points, focal, coarse_tolerance, coarse_tolerance, &found->cone) ||
        !sharpen(part, outline_refine, fine_rounds, &found->cone, &points))
        return BLOB_NO_OUTLINE;
    return judge_blob(*part.work, part.image, part.eye, points, found);
}

/* Takes `trial` over into `found` where it is a better ball. */
static void take_better(const scene_part &part, const outline_points &points, blob *trial,
                        blob_fault *fault, blob *found)
{
    const blob_fault now = judge_blob(*part.work, part.image, part.eye, points, trial);
    const bool first = *fault == BLOB_NO_OUTLINE || (*fault != BLOB_GOOD && now == BLOB_GOOD);

    if (!first &&
        ((now != BLOB_GOOD && *fault == BLOB_GOOD) || trial->score < better * found->score))
        return;
    *fault = now;
    *found = *trial;
}

/* A cone known to some px, as a round ball. */
static void try_cone(const scene_part &part, const outline &cone, blob_fault *fault, blob *found)
{
    outline_points points;
    blob trial;

    trial.cone = cone;
    if (sharpen(part, outline_refine, fine_rounds, &trial.cone, &points))
        take_better(part, points, &trial, fault, found);
}

/* What agrees with a cone as a whole, but not exactly, is fitted once more with a stretch. */
static void try_stretched(const scene_part &part, const outline_ends &ends, blob_fault *fault,
                          blob *found)
{
    const double radius = found->radius;
    outline_points points;
    blob trial = *found;

    vote_nearest(ends, found->cone, part.eye.focal, &points);
    if (outline_refine_stretched(points, part.eye.focal, stretch_share * radius,
                                 std::max(coarse_tolerance, coarse_relative * radius),
                                 &trial.cone) &&
        sharpen(part, outline_refine_stretched, stretched_rounds, &trial.cone, &points))
        take_better(part, points, &trial, fault, found);
}

static void look_from(const scene_part &part, const mask_piece &piece, const pixel_point &start,
                      blob_fault *fault, blob *found)
{
    const double side = std::max(piece.width, piece.height);
    const vote_limits limits = {part.eye.focal, coarse_tolerance, coarse_relative, part.radii.least,
                                std::min(part.radii.most, reach_of_piece * side)};
    outline cones[VOTE_CONES];
    outline_ends ends;

    edges_all(part.image, part.work->colours, part.eye, start, reach_of_piece * side, side, &ends);
    const int n = vote_cones(ends, limits, cones);
    for (int i = 0; i < n && worth_sharpening(part, cones[i]); i++) {
        const double tolerance =
            std::max(coarse_tolerance, coarse_relative * cones[i].tangent * part.eye.focal);
        outline_points points;
        vote_nearest(ends, cones[i], part.eye.focal, &points);
        if (outline_refine(points, part.eye.focal, tolerance, tolerance, &cones[i]))
            try_cone(part, cones[i], fault, found);
    }
    if (*fault != BLOB_NO_OUTLINE && judge_stretched(*part.work, *found))
        try_stretched(part, ends, fault, found);
}

/* A ball that is all surrounded by its own colour. */
static void look_for_edges(const scene_part &part, const mask_piece &piece, blob_fault *fault,
                           blob *found)
{
    const double side = std::max(piece.width, piece.height);
    const mask_work &mask = part.work->mask;
    const int left = mask.region.left + piece.box.x * mask.step;
    const int top = mask.region.top + piece.box.y * mask.step;
    const image_region region =
        image_clip(part.image, {left - edge_margin, top - edge_margin,
                                left + static_cast<int>(piece.width) + edge_margin,
                                top + static_cast<int>(piece.height) + edge_margin});
    outline cones[CIRCLES_CONES];

    const int n = circles_find(part.image, part.eye, region, part.radii.least,
                               std::min(part.radii.most, side / 2 + edge_margin), cones);
    for (int i = 0; i < n; i++)
        try_cone(part, cones[i], fault, found);
}

/* The thorough look, for what has prints, glints, or things of its colour around it. */
static blob_fault look_thoroughly(const scene_part &part, const mask_piece &piece, blob_fault fault,
                                  blob *found)
{
    pixel_point starts[MASK_STARTS];
    const int n = mask_starts(&part.work->mask, piece, starts);

    look_from(part, piece, piece.centre, &fault, found);
    for (int i = 0; i < n && !(fault == BLOB_GOOD && (i > 0 || judge_clear(*found))); i++)
        look_from(part, piece, starts[i], &fault, found);
    if (fault != BLOB_GOOD)
        look_for_edges(part, piece, &fault, found);
    return fault;
}

static bool clear_and_larger(const blob *blobs, int n, const mask_piece &piece)
{
    return std::any_of(blobs, blobs + n, [&piece](const blob &known) {
        return judge_clear(known) && 2 * known.radius > std::max(piece.width, piece.height);
    });
}

/* Two pieces of one ball lead to the same outline. */
static bool known_already(const blob *blobs, int n, const blob &found)
{
    return std::any_of(blobs, blobs + n, [&found](const blob &known) {
        return std::hypot(known.pixel.column - found.pixel.column,
                          known.pixel.row - found.pixel.row) < 0.5 * known.radius;
    });
}

static void refuse(segmenter *work, blob_fault fault, const mask_piece &piece, const blob &found)
{
    if (work->n_refused == SEGMENT_REFUSED)
        return;
    refused_blob *const place = &work->refused[work->n_refused++];
    if (fault == BLOB_NO_OUTLINE || found.radius <= 0)
        *place = {fault, piece.centre, std::max(piece.width, piece.height) / 2};
    else
        *place = {fault, found.pixel, found.radius};
}

const char *blob_fault_text(blob_fault fault)
{
    static const char *const texts[BLOB_FAULTS] = {"taken",
                                                   "no circle fits its edge",
                                                   "too small (ball.radius_min)",
                                                   "too large (ball.radius_max)",
                                                   "too little outline (ball.coverage_min)",
                                                   "too little colour (ball.fill_min)",
                                                   "edge too rough (ball.roughness)",
                                                   "colour goes on beyond it",
                                                   "no tag of marker.dictionary",
                                                   "a tag of another number (marker.id)"};

    return texts[fault];
}

int segment_find(segmenter *work, const image_view &image, const camera &eye,
                 const image_region &region, int step, blob *blobs)
{
    const image_region clipped = image_clip(image, region);
    const scene_part part = {work, image, eye, judge_radii(work->limits, eye)};
    mask_piece pieces[MASK_PIECES];
    blob found[MASK_PIECES];
    int n = 0;

    work->n_refused = 0;
    if (clipped.right - clipped.left < 2 * step || clipped.bottom - clipped.top < 2 * step)
        return 0;
    /* A part of a ball can be as small as what coverage_min leaves of the smallest. */
    const int n_pieces = mask_find(&work->mask, image, work->colours, clipped, step,
                                   0.5 * part.radii.least * part.radii.least,
                                   plausible_share * part.radii.most, pieces);
    if (n_pieces == 0 && work->mask.left_out.area >= speck)
        refuse(work, work->mask.left_out.width > part.radii.most ? BLOB_TOO_LARGE : BLOB_TOO_SMALL,
               work->mask.left_out, blob());
    for (int i = 0; i < n_pieces; i++) {
        blob_fault fault = look_quickly(part, pieces[i], &found[n]);
        if (!(fault == BLOB_GOOD && judge_clear(found[n]) && !judge_stretched(*work, found[n])) &&
            !clear_and_larger(found, n, pieces[i]))
            fault = look_thoroughly(part, pieces[i], fault, &found[n]);
        if (fault != BLOB_GOOD)
            refuse(work, fault, pieces[i], found[n]);
        else if (!known_already(found, n, found[n]))
            n++;
    }
    std::stable_sort(found, found + n,
                     [](const blob &a, const blob &b) { return a.score > b.score; });
    n = std::min(n, static_cast<int>(SEGMENT_CANDIDATES));
    std::copy(found, found + n, blobs);
    return n;
}
