# SPDX-License-Identifier: MIT
"""States and reasons in plain words: those of docs/troubleshooting.md."""

from typing import NamedTuple


class Reason(NamedTuple):
    meaning: str
    remedy: str


STATES = {
    "initializing": "There is no map yet.",
    "tracking": "The frame has a pose.",
    "rotation_only": "The frame has a rotation, but no position.",
    "lost": "The frame was not found in the map. After `relocalizer.max_lost_s` (1 s) a new segment "
    "may start; its scale and position relative to the earlier one are guessed until the camera "
    "sees that one's landmarks again.",
}

REASONS = {
    "none": Reason("The frame has a pose.", ""),
    "repeated_image": Reason(
        "The frame has a pose: its image repeats that of an earlier frame, and so does the pose. "
        "Frame-rate conversions and slow cameras repeat images, and a standing camera does.",
        "Nothing. Compute speeds from the frames without this reason.",
    ),
    "scale_uncertain": Reason(
        "The frame has a pose, but the scale may differ before and after it: half of the landmarks "
        "contradict the pose, or the speed has changed and the images do not show it.",
        "Mask large moving objects; do not compare lengths across these frames.",
    ),
    "reference_frame": Reason(
        "Initialization starts at this frame. It gets a pose afterwards if a later frame forms a "
        "map with it.",
        "If it is the only reason, the sequence is too short or the images are unrelated.",
    ),
    "too_few_features": Reason(
        "Fewer keypoints than `initializer.min_matches` (100): the image is dark, blurred, "
        "overexposed or blank.",
        "Light, exposure time, a mask that excludes less, `extractor.fast_threshold`.",
    ),
    "too_few_matches": Reason(
        "The features match neither the reference frame (before initialization) nor the map.",
        "Higher frame rate (smaller `--every`), less blur; large images often track better with "
        "`--resize 0.5`.",
    ),
    "low_parallax": Reason(
        "The camera stands still or has not moved far enough: the parallax is below "
        "`initializer.min_parallax_deg` (1°).",
        "Move sideways or forward. Depth cannot be observed from a standing camera.",
    ),
    "rotation_only": Reason(
        "The images are explained by a rotation alone. The rotation is reported "
        "(`rotations.tum`), a position cannot be.",
        "Move while turning. Also what a sequence with a very large fixed foreground looks like: "
        "use `--mask`.",
    ),
    "static_overlay": Reason(
        "Texture that moves with the camera (a bonnet, a robot arm) covers more than half of the "
        "image, and the rest has too few features; or the poses of the first frames depended on "
        "such texture, were discarded when it was found, and could not be computed again without it.",
        "Exclude it with `--mask`, and point the camera at more of the scene.",
    ),
    "planar": Reason(
        "A homography explains the matches: the scene is one plane, whose motion has two "
        "solutions. The initializer waits for views that tell them apart.",
        "Bring a second depth into view, or move along a curve.",
    ),
    "ambiguous_motion": Reason(
        "No motion explains the matches clearly better than all others.",
        "Check the camera file; a large moving object has the same effect.",
    ),
    "bad_triangulation": Reason(
        "Fewer than `min_points` (50, C++) points triangulate in front of both views, with "
        "parallax and a small error; or the adjustment of the first map failed.",
        "Check the camera file; move farther.",
    ),
    "too_few_inliers": Reason(
        "Tracking: fewer than `tracker.min_inliers` (20) landmarks agree with a pose, or no more "
        "than chance gives.",
        "Blur, fast rotation, moving objects, a cut to another place; see `--draw`.",
    ),
    "unreadable_image": Reason(
        "The file is missing its end, empty, damaged, or no image. Tracking went on with the next "
        "one.",
        "Copy the file again. `--strict` makes it an error.",
    ),
    "wrong_size": Reason(
        "The image does not have the size of the camera.",
        "Remove it from the folder, or sort images of two cameras into two folders.",
    ),
}
