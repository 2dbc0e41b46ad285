//! Values of one fabric on the way to a sheet.

use drape_input::round_digits;

use crate::results::average::AveragedValue;
use crate::results::item::Item;
use crate::test::Direction;

/// Averaged value with its place in the files.
#[derive(Clone, Debug)]
pub(crate) struct SourcedValue {
    pub(crate) value: AveragedValue,
    pub(crate) source: String,
}

/// Value of a drafted sheet.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct DraftValue {
    pub(crate) key: &'static str,
    pub(crate) direction: Option<Direction>,
    pub(crate) number: f64,
    pub(crate) deviation: Option<f64>,
    /// Spelling of the unit; `None` for a number without unit.
    pub(crate) unit: Option<&'static str>,
    /// Source and computation of the value.
    pub(crate) why: String,
}

/// Values of a drafted sheet, and values that a sheet has no key for.
#[derive(Clone, Debug, Default)]
pub(crate) struct ConvertedValues {
    pub(crate) values: Vec<DraftValue>,
    /// Values without a use in the sheet, each with the reason.
    pub(crate) unused: Vec<String>,
    pub(crate) notes: Vec<String>,
}

/// Values of one fabric during the conversion.
pub(crate) struct FabricValues {
    pub(crate) values: Vec<SourcedValue>,
}

impl FabricValues {
    /// Returns the value of `item` and `direction`.
    pub(crate) fn get(&self, item: Item, direction: Option<Direction>) -> Option<&SourcedValue> {
        self.values
            .iter()
            .find(|sourced| sourced.value.item == item && sourced.value.direction == direction)
    }

    /// Returns whether there is a value of `item` in any direction.
    pub(crate) fn has(&self, item: Item) -> bool {
        self.values.iter().any(|sourced| sourced.value.item == item)
    }

    /// Returns whether there are values of FAST or of a cantilever, and no value that only KES
    /// measures.
    pub(crate) fn are_fast(&self) -> bool {
        let mut items = self.values.iter().map(|sourced| sourced.value.item);
        items.clone().any(Item::is_fast) && !items.any(Item::is_only_of_kes)
    }

    /// Removes the value of `item` and `direction`.
    pub(crate) fn remove(&mut self, item: Item, direction: Option<Direction>) {
        self.values
            .retain(|sourced| (sourced.value.item, sourced.value.direction) != (item, direction));
    }
}

/// Returns the source and the remark of a value.
pub(crate) fn source_of(sourced: &SourcedValue) -> String {
    let remark = &sourced.value.remark;
    let remark = if remark.is_empty() { String::new() } else { format!(": {remark}") };
    format!("{}{remark}", sourced.source)
}

/// Returns a computed number with five significant digits.
pub(crate) fn computed(number: f64) -> f64 {
    round_digits(number, 5)
}
