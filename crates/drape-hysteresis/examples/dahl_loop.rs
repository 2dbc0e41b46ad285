//! Steady loop of a Dahl element, its area and its width against the closed forms.
//!
//! `cargo run --example dahl_loop -p drape-hysteresis`
#![allow(clippy::print_stdout, reason = "an example prints its result")]

use drape_hysteresis::Dahl;

fn main() {
    // Bending friction with a plateau of 6e-4 N and a pre-sliding curvature of 4 1/m over the cycle
    // of the KES bending tester, ±2.5 cm⁻¹.
    let (plateau, length, amplitude) = (6e-4, 4.0, 250.0);
    let element = Dahl::new(plateau, length).expect("a friction");

    // From a virgin element to the lower tip, then cycles until the loop closes.
    let mut lower = element.advance(0.0, -amplitude);
    let mut area = 0.0;
    for _ in 0..10 {
        let upper = element.advance(lower, 2.0 * amplitude);
        area = element.work(lower, 2.0 * amplitude) + element.work(upper, -2.0 * amplitude);
        lower = element.advance(upper, -2.0 * amplitude);
    }
    let upper = element.advance(lower, 2.0 * amplitude);

    // Area 4 F_c [q − x_f tanh(q/x_f)] and width 2 F_c [1 − cosh(p/x_f)/cosh(q/x_f)] at p.
    let exact = 4.0 * plateau * (amplitude - length * (amplitude / length).tanh());
    assert!((area / exact - 1.0).abs() < 1e-12, "{area} against {exact}");
    for at in [-100.0_f64, 0.0, 50.0, 100.0] {
        let rising = element.advance(lower, at + amplitude);
        let falling = element.advance(upper, at - amplitude);
        let cosines = (at / length).cosh() / (amplitude / length).cosh();
        let width = 2.0 * plateau * (1.0 - cosines);
        assert!((rising - falling - width).abs() < 1e-15, "{} against {width}", rising - falling);
    }
    println!("energy per cycle {area:.5} J/m², closed form {exact:.5} J/m²");
}
