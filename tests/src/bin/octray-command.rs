//! The command `octray`, as its package has it: for tests, which are only given the programs of
//! their own package.

fn main() -> std::process::ExitCode {
    octray::main(std::env::args_os())
}
