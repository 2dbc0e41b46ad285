//! A square bent over a cylinder: its energy against `½ B κ² A`.
//!
//! `cargo run --example cylinder -p drape-cloth`
#![allow(clippy::print_stdout, reason = "an example prints its result")]

use drape_cloth::{Cloth, Lattice};
use drape_fabric::{
    BendingBackbone, BendingLaw, BlimanSorine, Buckling, Fabric, Polynomial, SURFACE_FRICTION,
    ShearBackbone, ShearLaw, TractionBackbone, TractionLaw, YarnLaws,
};

const RIGIDITY: f64 = 1.2e-5;

/// A weave that bends elastically, with one bending rigidity for warp and weft.
fn fabric() -> Fabric {
    let laws = YarnLaws {
        traction: TractionLaw {
            backbone: TractionBackbone::Polynomial(Polynomial { quadratic: 8.4e4, quartic: 1.2e7 }),
            friction: BlimanSorine::none().into(),
            buckling: Buckling::default(),
        },
        bending: BendingLaw {
            backbone: BendingBackbone::Linear { rigidity: RIGIDITY },
            rest_curvature: 0.0,
            friction: BlimanSorine::none(),
        },
    };
    Fabric {
        name: "elastic weave".into(),
        source: String::new(),
        density: 0.12,
        thickness: 3e-4,
        pressed_thickness: None,
        compression_linearity: None,
        surface_friction: SURFACE_FRICTION,
        warp: laws,
        weft: laws,
        shear: ShearLaw {
            backbone: ShearBackbone::Linear { stiffness: 35.0 },
            friction: BlimanSorine::none(),
            growth: 0.0,
            locking: None,
        },
        provenance: None,
    }
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let (side, radius) = (0.2, 0.05);
    let lattice = Lattice::rectangle(side, side, 0.005)?;
    let cloth = Cloth::new(&[(&lattice, &fabric())])?;
    let state =
        cloth.state(lattice.coordinates().iter().flat_map(|&[u, v]| [u, v, 0.0]).collect())?;

    // Particles on the cylinder, with chords of the rest length between them: the yarns do not
    // stretch.
    let spacing = lattice.spacing()[0];
    let angle = 2.0 * (0.5 * spacing / radius).asin();
    let bent: Vec<f64> = lattice
        .coordinates()
        .iter()
        .flat_map(|&[u, v]| {
            let turned = angle * u / spacing;
            [radius * turned.sin(), v, radius * (1.0 - turned.cos())]
        })
        .collect();

    let energy = cloth.potential(&state, &bent)? - cloth.potential(&state, &state.positions)?;
    let curvature = angle / spacing;
    let exact = 0.5 * RIGIDITY * curvature * curvature * side * side;
    assert!((energy / exact - 1.0).abs() < 1e-6, "{energy:e} against {exact:e} J");
    println!("bending energy {energy:.6e} J, closed form {exact:.6e} J");
    Ok(())
}
