//! The command `octray`; all it does is in the library.

fn main() -> std::process::ExitCode {
    octray::main(std::env::args_os())
}
