//! Signals that ask the program to end.
//!
//! The first signal ends a run at its next step, or cancels the current step if that step takes
//! long. A later signal ends the program at once.

use std::sync::atomic::{AtomicBool, AtomicU8, Ordering};
use std::sync::{Arc, LazyLock, Once, OnceLock};
use std::time::{Duration, Instant};

use rustix::process::Signal;
use signal_hook::consts::{SIGINT, SIGTERM};
use signal_hook::iterator::Signals;

/// Signals within this time of the first one count as one signal, because shells and wrappers send
/// a signal to a process and to its group.
const DUPLICATE_WINDOW: Duration = Duration::from_millis(500);

/// Time that the current step has after the first signal. Then the step is cancelled.
const PATIENCE: Duration = Duration::from_millis(700);

/// Time of the first signal.
static FIRST_SIGNAL_TIME: OnceLock<Instant> = OnceLock::new();

/// Flag that cancels the current step.
static CANCEL_STEP: LazyLock<Arc<AtomicBool>> = LazyLock::new(Arc::default);

/// Number of the first signal, or 0 if none was received.
static RECEIVED: AtomicU8 = AtomicU8::new(0);

static WATCH: Once = Once::new();

/// Ignores `SIGXFSZ`, so that writing beyond the file size limit fails like writing to a full disk
/// instead of ending the program.
pub(crate) fn let_large_files_fail() {
    // If the signal cannot be registered, it still ends the program.
    let _ = signal_hook::flag::register(Signal::XFSZ.as_raw(), Arc::new(AtomicBool::new(false)));
}

/// Starts to record signals instead of ending at once. If signals cannot be watched, they still end
/// the program.
pub(crate) fn watch() {
    WATCH.call_once(|| {
        let Ok(mut signals) = Signals::new([SIGINT, SIGTERM]) else { return };
        std::thread::spawn(move || {
            // A thread waits for signals, because a handler may do little more than set a flag.
            let mut first_time = None;
            for signal in signals.forever() {
                let number = u8::try_from(signal).unwrap_or_default();
                let begin = *first_time.get_or_insert_with(Instant::now);
                if RECEIVED.load(Ordering::Relaxed) == 0 {
                    RECEIVED.store(number, Ordering::Relaxed);
                    let _ = FIRST_SIGNAL_TIME.set(Instant::now());
                    std::thread::spawn(|| {
                        std::thread::sleep(PATIENCE);
                        CANCEL_STEP.store(true, Ordering::Relaxed);
                    });
                } else if begin.elapsed() > DUPLICATE_WINDOW {
                    std::process::exit(128 + signal);
                }
            }
        });
    });
}

/// Returns the number of the first signal, or `None` before it.
pub(crate) fn received() -> Option<u8> {
    Some(RECEIVED.load(Ordering::Relaxed)).filter(|signal| *signal > 0)
}

/// Returns the time since the first signal, or `None` before it.
pub(crate) fn time_since_first() -> Option<Duration> {
    FIRST_SIGNAL_TIME.get().map(Instant::elapsed)
}

/// Returns the flag that becomes `true` when the current step is to be cancelled, [`PATIENCE`]
/// after the first signal.
pub(crate) fn cancel_step_flag() -> Arc<AtomicBool> {
    CANCEL_STEP.clone()
}
