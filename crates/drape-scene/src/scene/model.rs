//! Model of the internal forces of the cloth.

/// Model of the internal forces of the cloth.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Model {
    /// Yarn connectors with the laws of the fabric, friction included \[NB04\].
    #[default]
    Kes,
    /// Interacting particles without friction \[BHW94\]: see [`drape_cloth::Breen`].
    Breen1994,
}
