//! The command `octray` as in its package, because tests can only run programs of their own package.

fn main() -> std::process::ExitCode {
    octray::main(std::env::args_os())
}
