//! The behaviour of the program, seen from outside: one module for each command or promise.

#[path = "../support/mod.rs"]
mod support;

mod acceptance;
mod all_at_once;
mod altered;
mod bad;
mod bundle;
mod cache;
mod cli;
mod compare;
mod diff;
mod drawn_bodies;
mod drawn_textures;
mod engine;
mod external;
mod fabric_test;
mod faults;
mod fit;
mod line;
mod measured_bodies;
mod mistakes;
mod motion;
mod new;
mod platform;
mod princess;
mod renewed;
mod silent_settings;
mod study;
mod torn_bodies;
mod truncated;
mod verbs;
mod watch;
