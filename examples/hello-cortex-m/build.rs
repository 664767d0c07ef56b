fn main() {
    octray_prepare::bake::file("../../scenes/figure-22.scene")
        .size(64, 48)
        .write();
    // Where the linker finds memory.x.
    println!("cargo::rustc-link-search={}", env!("CARGO_MANIFEST_DIR"));
}
