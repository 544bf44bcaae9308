//! `toile stages [NAME]`

use super::args::StagesArgs;
use super::console::Console;
use crate::engine::Exit;
use crate::pipeline::remedy;
use crate::schema::manual;
use toile_stage_api::Registry;

pub(super) fn run(args: &StagesArgs, registry: &Registry, console: &mut Console<'_>) -> Exit {
    let Some(name) = &args.name else {
        for stage in registry.iter() {
            let info = stage.info();
            console.result(&format!("{:<16} {}\n", info.name, info.summary));
        }
        return Exit::Good;
    };
    if let Some(stage) = registry.get(name) {
        console.result(&manual(stage));
        return Exit::Good;
    }
    let names: Vec<String> = registry.iter().map(|s| s.info().name.into_owned()).collect();
    let hint = remedy(name, names.iter().map(String::as_str));
    console.say(&format!("error[unknown-stage] unknown stage `{}`\n  help: {hint}\n", crate::render::safe(name)));
    Exit::Usage
}
