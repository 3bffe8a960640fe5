//! The modules of the page and of its workers, as they are handed out, come in parts. What cuts them needs to be told by the linker what
//! refers to what.

use std::env;

fn main() {
    println!("cargo::rerun-if-changed=Cargo.toml");
    println!("cargo::rustc-check-cfg=cfg(in_parts)");
    let is = |name: &str, value: &str| env::var(name).is_ok_and(|found| found == value);
    if is("PROFILE", "release") && is("CARGO_CFG_TARGET_ARCH", "wasm32") {
        println!("cargo::rustc-cfg=in_parts");
        println!("cargo::rustc-link-arg-bins=--emit-relocs");
    }
}
