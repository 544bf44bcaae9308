//! The engine and command line of toile.
