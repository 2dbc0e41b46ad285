/// How many elements the friction of a bending or shear law has.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum FrictionOrder {
    /// One element: loops whose friction settles to one plateau.
    #[default]
    First,
    /// Two elements, a fast and a slow one. The slow one counts negative for stiction and a Stribeck drop,
    /// positive for loops that grow with their amplitude; the fit finds which.
    Second,
}

/// Which law a bending or a shear loop is fitted with.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LoopModel {
    /// A line with friction, along the whole history [Ngo Ngoc & Boivin 2004, eqs. 4–5].
    Linear(FrictionOrder),
    /// A quadratic and a line without friction, on the first loading branch
    /// [Breen, House & Wozny 1994, §5.1].
    Piecewise,
}

impl Default for LoopModel {
    fn default() -> Self {
        Self::Linear(FrictionOrder::First)
    }
}
