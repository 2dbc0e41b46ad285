//! Panels, cloths, states and seams.

use drape::cloth::{
    Allowance, Breen, Cloth, Fold, Grain, Interpolation, Lattice, Mesh, ReferenceCloth, Seam,
    SeamBending, Tie,
};
use drape::fabric::{Fabric, samples};

use crate::shapes::Source;

/// Largest number of particles that are evaluated.
const PARTICLES_MAX: usize = 300;

fn mesh(source: &mut Source<'_>) -> Mesh {
    let columns = 1 + source.below(3) as u32;
    let spacing = source.mostly_positive(8);
    let at = |column: u32, row: u32| row * (columns + 1) + column;
    let grid: Vec<[u32; 2]> =
        (0..2).flat_map(|row| (0..=columns).map(move |column| [column, row])).collect();
    let mut mesh = Mesh {
        spacing: [spacing; 2],
        coordinates: grid.iter().map(|&p| p.map(|k| spacing * f64::from(k))).collect(),
        cells: (0..columns).map(|c| [at(c, 0), at(c + 1, 0), at(c + 1, 1), at(c, 1)]).collect(),
        triangles: Vec::new(),
        grid,
    };
    mesh.coordinates.push([0.5 * spacing, 1.7 * spacing]);
    mesh.triangles.push([at(0, 1), at(1, 1), mesh.coordinates.len() as u32 - 1]);
    match source.below(6) {
        0 => mesh.grid.clear(),
        1 => mesh.cells.clear(),
        2 => mesh.triangles = source.triangles(4, mesh.coordinates.len()),
        3 => {
            let node = source.below(mesh.coordinates.len() as u64) as usize;
            mesh.coordinates[node][source.below(2) as usize] = source.odd();
        }
        4 => mesh.grid[0] = [source.whole() as u32, source.whole() as u32],
        _ => {}
    }
    mesh
}

fn lattice(source: &mut Source<'_>) -> Option<Lattice> {
    let grain = Grain::from_degrees(if source.below(4) == 0 { source.odd() } else { 20.0 });
    let size = [0.0; 2].map(|_| source.mostly_positive(6));
    let spacing = if source.below(3) == 0 {
        source.odd()
    } else {
        size[0].abs().min(size[1].abs()) / source.between(2.0, 8.0)
    };
    // Millions of particles are right, and take minutes.
    let cells = size.iter().map(|side| side / spacing).fold(0.0, f64::max);
    let spacing = if cells.is_finite() && cells > 300.0 { size[0] } else { spacing };
    let lattice = match source.below(5) {
        0 => Lattice::rectangle(size[0], size[1], spacing),
        1 => Lattice::rectangle_at(grain, [source.odd(), source.odd()], size, spacing),
        2 => Lattice::disc(size[0], spacing),
        3 => Lattice::ring_on([0.0; 2], size, spacing),
        _ => Lattice::from_mesh(mesh(source), grain),
    };
    let lattice = lattice.ok().filter(|lattice| lattice.particle_count() <= PARTICLES_MAX)?;
    let _ = lattice.depths(source.below(4) as usize, source.odd());
    let count = lattice.particle_count();
    match source.below(4) {
        0 => {
            let line = (0..source.below(4)).map(|_| source.number(count)).collect();
            lattice.with_allowances(&[Allowance { line, width: source.odd() }]).ok()
        }
        1 => {
            let ends = [[source.odd(), source.odd()], [source.odd(), source.odd()]];
            lattice.with_folds(&[Fold { ends, angle: source.odd() }]).ok()
        }
        2 => {
            let (offset, slope) = (source.odd(), source.odd());
            let area = lattice.area();
            let graded = lattice.graded(|[u, v]| offset + slope * (u - v)).ok()?.lattice;
            let error = (graded.area() - area).abs();
            assert!(!area.is_finite() || error <= 1e-9 * area.abs(), "{area} lost {error}");
            Some(graded)
        }
        _ => Some(lattice),
    }
}

fn fabric(source: &mut Source<'_>) -> Fabric {
    let mut fabric = samples::plain_weave();
    match source.below(5) {
        0 => fabric.density = source.odd(),
        1 => fabric.shear.growth = source.odd(),
        2 => fabric.shear.friction.elements[0].length = source.odd(),
        _ => {}
    }
    fabric
}

pub fn evaluate(source: &mut Source<'_>) {
    let fabrics = [fabric(source), fabric(source)];
    let lattices: Vec<Lattice> = (0..source.below(3)).filter_map(|_| lattice(source)).collect();
    let panels: Vec<(&Lattice, &Fabric)> = lattices.iter().zip(&fabrics).collect();
    if let [first, second] = &lattices[..] {
        let interpolation = Interpolation::new(first, second);
        let _ = interpolation.apply(&source.odd_list(3 * first.particle_count()));
    }
    let Ok(cloth) = Cloth::new(&panels) else {
        assert!(Breen::new(&panels).is_err(), "the model of Breen takes what a cloth refuses");
        return;
    };
    let count = cloth.particle_count();
    let flat: Vec<f64> = cloth.coordinates().iter().flat_map(|&[u, v]| [u, v, 0.0]).collect();
    let start = if source.below(3) == 0 { source.odd_list(3 * count) } else { flat.clone() };
    let Ok(mut state) = cloth.state(start) else { return };

    // A state of another cloth, and lists that are too short or too long.
    let other = samples::plain_weave();
    let square = Lattice::rectangle(0.02, 0.02, 0.01).expect("a square");
    let stranger = Cloth::new(&[(&square, &other)]).expect("a cloth");
    let strange = stranger.state(vec![0.0; 27]).expect("nine particles");
    assert!(count == 9 || cloth.stored(&strange).is_err(), "another cloth's state was taken");
    let trial = source.odd_list(3 * count);
    let (mut forces, blocks) = (source.odd_list(3 * count), cloth.sparsity().block_count());
    let mut values = vec![0.0; source.length(9 * blocks)];
    let _ = cloth.add_forces(&state, &trial, &mut forces);
    let _ = cloth.add_stiffness(&state, &trial, source.below(2) == 0, &mut values);
    let _ = cloth.potential(&state, &trial);
    let _ = cloth.triangle_strains(&trial);
    let mut workspace = stranger.workspace();
    assert!(count == 9 || workspace.stored(&cloth, &state).is_err(), "another workspace served");
    let _ = cloth.commit(&mut state, &trial, &source.odd_list(3 * count));
    let _ = cloth.strains(&state);
    let _ = cloth.stored(&state);
    if let Ok(mut reference) = ReferenceCloth::new(&panels, &cloth, &state) {
        let _ = reference.add_forces(&trial, &mut forces);
        let _ = reference.commit(&trial, &source.odd_list(3 * count));
    }

    let pairs = (0..source.below(4)).map(|_| [0; 2].map(|_| source.number(count))).collect();
    let mut tie = || Tie {
        particle: source.number(count),
        ends: [source.number(count), source.number(count)],
        fraction: source.odd(),
    };
    let ties = vec![tie(), tie()];
    let seam = Seam {
        ties: if source.below(2) == 0 { ties.clone() } else { Vec::new() },
        stiffness: source.mostly_positive(4),
        rest_angle: source.between(-3.0, 3.0),
        ..Seam::new(pairs)
    };
    if let Ok(seams) = SeamBending::new(&panels, &[seam])
        && let Ok(mut bent) = seams.state(&flat)
    {
        let _ = seams.add_forces(&bent, &trial, &mut forces);
        let _ = seams.potential(&bent, &trial);
        let _ = seams.commit(&mut bent, &trial);
    }
    if let Ok(mut breen) = Breen::new(&panels) {
        let _ = breen.energy(&trial);
        let _ = breen.add_forces(&trial, &mut forces);
        let _ = breen.close_pairs(&trial);
    }
    let _ = cloth.with_ties(&ties);
}
