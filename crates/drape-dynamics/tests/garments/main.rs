//! Garments: worn over each other, and held by pins in some directions alone.

#![allow(clippy::unwrap_used)]

mod attachments;
mod blocked_seam;
mod darts;
mod layers;

/// A tube of 40 mm height in two halves of a width, each wrapped to a radius, both in mm; it closes
/// to the radius width / π.
fn tube(width: u32, radius: u32) -> String {
    let pattern = r#"length = "mm"
[panel.front]
grain = 0
start = [-HALF, 0]
outline = [
    { name = "bottom", to = [HALF, 0] },
    { name = "left", to = [HALF, 40] },
    { name = "top", to = [-HALF, 40] },
    { name = "right", to = [-HALF, 0] },
]
origin = [0, 0, RADIUS]
wrap = RADIUS
[panel.back]
grain = 0
start = [-HALF, 0]
outline = [
    { name = "bottom", to = [HALF, 0] },
    { name = "right", to = [HALF, 40] },
    { name = "top", to = [-HALF, 40] },
    { name = "left", to = [-HALF, 0] },
]
origin = [0, 0, -RADIUS]
turn = [0, 180, 0]
wrap = RADIUS
[seam.left]
sides = [["front.left"], ["back.left"]]
[seam.right]
sides = [["back.right"], ["front.right"]]
"#;
    pattern.replace("HALF", &(width / 2).to_string()).replace("RADIUS", &radius.to_string())
}
