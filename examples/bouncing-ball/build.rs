use octray_prepare::{Arith, FirmwareTree};

fn main() {
    octray_prepare::bake::file("ball.scene")
        .size(64, 48)
        .arith(Arith::I16F16)
        // The program builds the tree, as objects move: the ball up and down, within this room.
        .tree(FirmwareTree::DEVICE)
        .room([-0.5, 0.0, -0.5], [0.5, 2.6, 0.5])
        .write();
    // Where the linker finds memory.x.
    println!("cargo::rustc-link-search={}", env!("CARGO_MANIFEST_DIR"));
}
