//! Identifies a fabric from a sheet with KES values and one noisy bending loop, and prints the
//! parameters of the loop with their 95 % intervals.

use drape_fabric::{BendingBackbone, BendingLaw, BlimanSorine, Law, drive};
use drape_fit::identify;
use drape_kes::{Curve, Direction, Sheet, Test, Values};

/// Bending law that the loop is measured on: rigidity in N·m, friction plateau in N and length in
/// 1/m.
const TRUTH: [f64; 3] = [1.2e-5, 6e-4, 12.0];

/// A KES-FB2 cycle, in steps of 2 1/m, with noise of half a percent of its range.
fn bending_loop() -> Result<Curve, drape_kes::Error> {
    let [rigidity, plateau, length] = TRUTH;
    let law = BendingLaw {
        backbone: BendingBackbone::Linear { rigidity },
        rest_curvature: 0.0,
        friction: BlimanSorine::first_order(plateau, length).expect("a friction"),
    };
    let curvature: Vec<f64> =
        (0..=125).chain((-125..125).rev()).map(|i| 2.0 * f64::from(i)).collect();
    let mut moment = drive(&law, law.virgin(), &curvature);
    for (i, moment) in moment.iter_mut().enumerate() {
        // A sequence without correlation between neighbours, from −1 to 1.
        let noise = ((i * i) as f64 * 0.618_033_988_75).fract() * 2.0 - 1.0;
        *moment += 5e-5 * noise;
    }
    Curve::new(Test::Bending, Direction::Warp, curvature, moment)
}

#[allow(clippy::print_stdout, reason = "an example prints its result")]
fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut sheet = Sheet::default();
    sheet.name = "shirting".into();
    // Mass per area in mg/cm², and values of a KES table in the laboratory's units.
    sheet.w = Some(12.0);
    let values = Values {
        g: Some(0.7),
        two_hg: Some(0.9),
        two_hg5: Some(1.8),
        lt: Some(0.72),
        rt: Some(62.0),
        em: Some(4.5),
        ..Values::default()
    };
    (sheet.warp, sheet.weft) = (values, values);
    sheet.curves.push(bending_loop()?);

    let fit = identify(&sheet)?;
    assert_eq!(fit.fabric.density, 0.12);
    let bending = &fit.curves[0];
    assert!(bending.stop.converged() && bending.misfit < 0.01);
    let parameter = |name: &str| bending.parameters.iter().find(|p| p.name == name);
    for (name, truth) in ["rigidity", "plateau", "length"].into_iter().zip(TRUTH) {
        let estimate = parameter(name).ok_or("a linear law with friction has it")?;
        let [lower, upper] = estimate.interval.clone().map_err(|reason| reason.to_string())?;
        println!("{name}: {:.3e}, 95 % interval {lower:.3e} to {upper:.3e}", estimate.value);
        assert!(lower < truth && truth < upper, "{name} is {truth:e}");
    }
    // The weft was not bent: its law is the warp's, and the fit says so.
    assert!(fit.assumed.contains(&"weft bending: not measured, the warp's taken".to_owned()));
    Ok(())
}
