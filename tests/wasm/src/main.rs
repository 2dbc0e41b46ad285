//! Prints what the functions return on the machine itself.

fn main() {
    println!("{:e} {:e}", drape_wasm::fitted_rigidity(), drape_wasm::lowest_height(40));
}
