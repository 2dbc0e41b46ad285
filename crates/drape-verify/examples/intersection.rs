//! Tests a triangle whose tip is lowered to a floor, one floating-point number at a time.
//!
//! `cargo run -p drape-verify --example intersection`

#![allow(clippy::print_stdout)]

use drape_verify::triangles_intersect;

fn main() {
    let floor = [[0.1, 0.1, 0.1], [0.7, 0.1, 0.1], [0.1, 0.1, 0.7]];
    let lowered_to = |height: f64| [[0.2, height, 0.2], [0.3, 0.5, 0.2], [0.2, 0.4, 0.3]];

    let above = 0.1_f64.next_up();
    assert!(!triangles_intersect(floor, lowered_to(above)), "above the floor it is clear");
    assert!(triangles_intersect(floor, lowered_to(0.1)), "on the floor it touches");
    assert!(triangles_intersect(floor, lowered_to(0.1_f64.next_down())), "below, it crosses");
    println!("clear at {above:.20} m, touching at {:.20} m", 0.1);
}
