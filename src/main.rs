//! The command line of toile.

fn main() -> std::process::ExitCode {
    toile::cli::main(toile_stages::builtin())
}
