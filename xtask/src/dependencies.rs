//! The dependencies of the workspace, as `cargo metadata` lists them.

use crate::run::root;
use serde_json::Value;
use std::collections::BTreeSet;
use std::path::PathBuf;
use std::process::Command;

/// One package of others.
pub struct Dependency {
    /// Its name.
    pub name: String,
    /// Its version.
    pub version: String,
    /// Its licences, as an expression.
    pub licence: String,
    /// Where it was taken from.
    pub source: String,
    /// The folder of its sources.
    pub folder: PathBuf,
}

/// All packages of others, in alphabetical order; only what `package` is built of, where one is named.
pub fn all(package: Option<&str>) -> Result<Vec<Dependency>, String> {
    let words = ["metadata", "--format-version", "1", "--locked"];
    let output = Command::new("cargo").args(words).current_dir(root()).output().map_err(|e| format!("cargo: {e}"))?;
    if !output.status.success() {
        return Err(String::from_utf8_lossy(&output.stderr).into_owned());
    }
    let metadata: Value = serde_json::from_slice(&output.stdout).map_err(|e| format!("cargo metadata: {e}"))?;
    let packages = list(&metadata["packages"]);
    let wanted = package.map(|name| built_of(&metadata, packages, name));
    let mut found: Vec<Dependency> = packages
        .iter()
        .filter(|p| p["source"].is_string() && wanted.as_ref().is_none_or(|ids| ids.contains(text(&p["id"]))))
        .map(dependency)
        .collect();
    found.sort_by(|a, b| (&a.name, &a.version).cmp(&(&b.name, &b.version)));
    Ok(found)
}

fn dependency(package: &Value) -> Dependency {
    let manifest = PathBuf::from(text(&package["manifest_path"]));
    Dependency {
        name: text(&package["name"]).to_owned(),
        version: text(&package["version"]).to_owned(),
        licence: text(&package["license"]).to_owned(),
        source: text(&package["source"]).to_owned(),
        folder: manifest.parent().map(PathBuf::from).unwrap_or_default(),
    }
}

/// The ids of a package and of all that it is built of, on any platform; tests and build scripts apart.
fn built_of<'m>(metadata: &'m Value, packages: &'m [Value], name: &str) -> BTreeSet<&'m str> {
    let nodes = list(&metadata["resolve"]["nodes"]);
    let first = packages.iter().find(|p| text(&p["name"]) == name && p["source"].is_null()).map(|p| text(&p["id"]));
    let mut open: Vec<&str> = first.into_iter().collect();
    let mut seen = BTreeSet::new();
    while let Some(id) = open.pop() {
        if !seen.insert(id) {
            continue;
        }
        let Some(node) = nodes.iter().find(|n| text(&n["id"]) == id) else { continue };
        let normal = |dep: &&Value| list(&dep["dep_kinds"]).iter().any(|kind| kind["kind"].is_null());
        open.extend(list(&node["deps"]).iter().filter(normal).map(|dep| text(&dep["pkg"])));
    }
    seen
}

fn list(value: &Value) -> &[Value] {
    value.as_array().map(Vec::as_slice).unwrap_or_default()
}

fn text(value: &Value) -> &str {
    value.as_str().unwrap_or("")
}
