use super::Simulation;
use crate::summary::Status;

impl Simulation {
    /// Ends a run in which surfaces are held nearer to each other than they are to keep.
    pub(super) fn judge_growth(&mut self) {
        let Some(surfaces) = &self.world.surfaces else { return };
        if self.status == Status::Ok && surfaces.is_stuck(self.time()) {
            let part = 100.0 * surfaces.contact.growth_fraction();
            let tight = self.tightest().map(|place| format!("; {place}")).unwrap_or_default();
            self.reason = Some(format!(
                "surfaces came to {part:.2} % of the distances that they keep{tight}"
            ));
            self.status = Status::HeldTogether;
        }
    }

    /// What to say of a run that ended before surfaces kept their whole distances.
    pub(super) fn stunted(&self) -> Vec<String> {
        let part = self.world.grown();
        if part >= 1.0 || self.status != Status::Ok {
            return Vec::new();
        }
        vec![format!(
            "surfaces keep only {:.2} % of their distances yet: the run ended before contact.grow",
            100.0 * part
        )]
    }
}
