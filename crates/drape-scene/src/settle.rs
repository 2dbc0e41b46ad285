use crate::file::SceneFile;
use crate::reader::Reader;

/// Speed below which cloth is at rest when the scene does not say, in m/s.
const SPEED: f64 = 0.002;

/// Acceleration below which cloth is at rest when the scene does not say, over g.
const RESIDUAL: f64 = 1e-3;

/// Part of the spacing that a particle may move in one step when the scene does not say.
///
/// Longer strides take fewer steps of more iterations each, and follow the path, which a fabric
/// with friction remembers, less closely. With a half instead of a quarter a square metre on a cube took
/// as long, and with half the spacing about a quarter less; what it stored at rest moved by 0.2 %, on a
/// sphere by 4 %.
const STRIDE: f64 = 0.25;

/// How a simulation goes to rest, and when it is there.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Settle {
    /// Largest speed of a particle at rest, in m/s.
    pub speed: f64,
    /// Largest root-mean-square acceleration at rest, over g: what the forces lack for balance.
    pub residual: f64,
    /// How far a particle may move in one step, in m.
    pub stride: f64,
    /// Whether the cloth keeps its momentum.
    ///
    /// Without, it creeps as if in honey: each step starts from rest, ends in a state of less
    /// energy, and moves the memory of the fabric along; lengths of steps are then not durations.
    pub inertia: bool,
}

impl Reader<'_> {
    pub(crate) fn settle(
        &mut self,
        file: &SceneFile,
        (spacing, unit): (f64, f64),
    ) -> Option<Settle> {
        let settle = file.settle.as_ref()?;
        let speed = settle.speed.unwrap_or(SPEED);
        self.within("settle.speed", speed, (1e-6, 10.0), "in m/s; 0.002 is usual");
        let residual = settle.residual.unwrap_or(RESIDUAL);
        self.within("settle.residual", residual, (1e-8, 1.0), "over g; 0.001 is usual");
        let stride = settle.stride.map_or(STRIDE * spacing, |stride| stride * unit);
        let help = "a length; a quarter of the spacing is usual";
        self.within("settle.stride", stride, (1e-7, 1.0), help);
        let inertia = settle.inertia.unwrap_or(false);
        Some(Settle { speed, residual, stride, inertia })
    }

    /// How long things move when the cloth has come to rest, in s.
    pub(crate) fn motion_phase(&mut self, file: &SceneFile) -> Option<f64> {
        let seconds = file.motion.as_ref()?.seconds;
        self.within("motion.seconds", seconds, (file.time.step, 1e5), "in s, at least one step");
        if file.settle.is_none() {
            let help = "add [settle], or leave [motion] out: bodies then move from the start";
            self.fail("motion", "the cloth is not asked to come to rest".into(), help);
        }
        Some(seconds)
    }
}
