//! Driver of libFuzzer: tries the target of the variable `TARGET` with bytes that reach new code.

#![no_main]

use std::sync::LazyLock;

use drape_fuzz::Target;
use libfuzzer_sys::fuzz_target;

static TARGET: LazyLock<Target> = LazyLock::new(|| {
    let name = std::env::var("TARGET").expect("the variable TARGET names a target");
    drape_fuzz::target(&name).expect("a target of that name")
});

fuzz_target!(|bytes: &[u8]| (TARGET.run)(bytes));
