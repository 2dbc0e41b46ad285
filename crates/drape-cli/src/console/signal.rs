//! Signals that ask the program to end: the first one ends a run at its next step, or gives up the
//! step in hand if that takes long; a later one ends the program at once.

use std::sync::atomic::{AtomicBool, AtomicU8, Ordering};
use std::sync::{Arc, LazyLock, Once, OnceLock};
use std::time::{Duration, Instant};

use rustix::process::Signal;
use signal_hook::consts::{SIGINT, SIGTERM};
use signal_hook::iterator::Signals;

/// Time after the first signal in which others count as the same one, since shells and wrappers
/// send it to a process and to its group.
const SAME: Duration = Duration::from_millis(500);

/// Time after the first signal until which the current step may end; then it is cancelled.
const PATIENCE: Duration = Duration::from_millis(700);

/// Time of the first signal.
static FIRST: OnceLock<Instant> = OnceLock::new();

/// Flag that cancels the current step.
static GIVE_UP: LazyLock<Arc<AtomicBool>> = LazyLock::new(Arc::default);

/// Number of the first signal that was received; 0 for none.
static RECEIVED: AtomicU8 = AtomicU8::new(0);

static WATCH: Once = Once::new();

/// Lets a file beyond the limit of its size fail as one on a full disk does, instead of ending the
/// program.
pub(crate) fn let_large_files_fail() {
    // Where that is not possible, the signal ends the program as before.
    let _ = signal_hook::flag::register(Signal::XFSZ.as_raw(), Arc::new(AtomicBool::new(false)));
}

/// Begins to note signals instead of ending at once. Where they cannot be watched, they end the
/// program as before.
pub(crate) fn watch() {
    WATCH.call_once(|| {
        let Ok(mut signals) = Signals::new([SIGINT, SIGTERM]) else { return };
        std::thread::spawn(move || {
            let mut first = None;
            for signal in signals.forever() {
                let number = u8::try_from(signal).unwrap_or_default();
                let since = *first.get_or_insert_with(Instant::now);
                if RECEIVED.load(Ordering::Relaxed) == 0 {
                    RECEIVED.store(number, Ordering::Relaxed);
                    let _ = FIRST.set(Instant::now());
                    std::thread::spawn(|| {
                        std::thread::sleep(PATIENCE);
                        GIVE_UP.store(true, Ordering::Relaxed);
                    });
                } else if since.elapsed() > SAME {
                    std::process::exit(128 + signal);
                }
            }
        });
    });
}

/// Returns the number of the signal that was received.
pub(crate) fn received() -> Option<u8> {
    Some(RECEIVED.load(Ordering::Relaxed)).filter(|signal| *signal > 0)
}

/// Returns the time since the first signal.
pub(crate) fn since() -> Option<Duration> {
    FIRST.get().map(Instant::elapsed)
}

/// Returns the flag that gives up the step in hand, some time after the first signal.
pub(crate) fn give_up_flag() -> Arc<AtomicBool> {
    GIVE_UP.clone()
}
