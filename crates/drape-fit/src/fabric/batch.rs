//! Many fabrics on all threads, in the memory of a few.

use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Mutex, PoisonError};

use drape_kes::Sheet;

use crate::error::Error;
use crate::fabric::identify::{Fit, identify_with};
use crate::settings::FitSettings;
use crate::threads::on_each_thread;

/// Sheet of a batch with its fit.
#[derive(Clone, Copy, Debug)]
pub struct FittedSheet<'a> {
    /// Sheet that was read.
    pub sheet: &'a Sheet,
    /// Fabric that was identified from it.
    pub fit: &'a Fit,
}

/// Identifies the fabrics of all `inputs` on all threads of the current pool. Returns a summary of
/// each, in the order of `inputs`.
///
/// Each thread reads one sheet at a time, identifies and summarises it, and drops both. Memory
/// therefore grows with the summaries, not with the number of sheets. A sheet that cannot be read
/// or identified is summarised as its error, and does not stop the others. `summarise` is called as
/// each fabric is finished, in any order, so it may advance a progress bar too. The returned list
/// is equal for any number of threads.
///
/// ```
/// use drape_fit::{Error, FitSettings, identify_all};
/// use drape_kes::{Sheet, Values};
///
/// let read = |b: &f64| {
///     let mut sheet = Sheet::default();
///     sheet.name = format!("B = {b}");
///     sheet.warp = Values { b: Some(*b), ..Values::default() };
///     Ok::<_, Error>(sheet)
/// };
/// let names = identify_all(&[0.05, 0.1], &FitSettings::default(), read, |_, result| {
///     result.map(|fitted| fitted.fit.fabric.name.clone())
/// });
/// assert_eq!(names[1].as_deref().ok(), Some("B = 0.1"));
/// ```
pub fn identify_all<I: Sync, E: From<Error>, T: Send>(
    inputs: &[I],
    settings: &FitSettings,
    read: impl Fn(&I) -> Result<Sheet, E> + Sync,
    summarise: impl Fn(&I, Result<FittedSheet<'_>, E>) -> T + Sync,
) -> Vec<T> {
    let next = AtomicUsize::new(0);
    let summaries = Mutex::new(Vec::with_capacity(inputs.len()));
    // Each thread runs one loop and takes the next sheet when it has done one. As many small tasks,
    // a thread that waits for the curves of its sheet would begin another sheet and hold both.
    on_each_thread(|| {
        while let Some((index, input)) = {
            let index = next.fetch_add(1, Ordering::Relaxed);
            inputs.get(index).map(|input| (index, input))
        } {
            let summary = match read(input) {
                Ok(sheet) => match identify_with(&sheet, settings) {
                    Ok(fit) => summarise(input, Ok(FittedSheet { sheet: &sheet, fit: &fit })),
                    Err(error) => summarise(input, Err(error.into())),
                },
                Err(error) => summarise(input, Err(error)),
            };
            // A summary that panics ends its thread and leaves the list intact.
            summaries.lock().unwrap_or_else(PoisonError::into_inner).push((index, summary));
        }
    });

    let mut summaries = summaries.into_inner().unwrap_or_else(PoisonError::into_inner);
    summaries.sort_by_key(|(index, _)| *index);
    summaries.into_iter().map(|(_, summary)| summary).collect()
}
