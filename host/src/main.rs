//! The command `octray`; the library holds all of it.

fn main() -> std::process::ExitCode {
    octray::main(std::env::args_os())
}
