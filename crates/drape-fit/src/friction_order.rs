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
