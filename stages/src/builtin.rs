//! The list of built-in stages: one line each.

use toile_stage_api::Registry;

/// All built-in stages.
#[must_use]
pub fn builtin() -> Registry {
    #[cfg(feature = "experiments")]
    crate::experiment::begin_from_environment();
    Registry::default()
        .with(crate::import_dxf::ImportDxf)
        .with(crate::import_garment::ImportGarment)
        .with(crate::import_garmentcode::ImportGarmentcode)
        .with(crate::import_mesh::ImportMesh)
        .with(crate::alter::Alter)
        .with(crate::triangulate::Triangulate)
        .with(crate::assemble::Assemble)
        .with(crate::stitch::Stitch)
        .with(crate::drape::Drape)
        .with(crate::animate::Animate)
        .with(crate::transfer::Transfer)
        .with(crate::texture::Texture)
        .with(crate::export_gltf::ExportGltf)
        .with(crate::export_obj::ExportObj)
        .with(crate::flatten::Flatten)
        .with(crate::export_dxf::ExportDxf)
        .with(crate::export_print::ExportPrint)
        .with(crate::export_picture::ExportPicture)
        .with(crate::export_report::ExportReport)
}

#[cfg(test)]
mod tests {
    use super::builtin;
    use crate::testing::{lend, piece};
    use toile_garment::Garment;
    use toile_stage_api::{AnyStage, Forecast, MeshSize, ReadyStage};
    use toml::de::ValueDeserializer;

    /// The stage with no more parameters than it must have; each of these is a text.
    fn with_least_params(stage: &dyn AnyStage) -> Box<dyn ReadyStage + '_> {
        let mut keys: Vec<String> = Vec::new();
        loop {
            let given: Vec<String> = keys.iter().map(|k| format!("{k} = \"none.toml\"")).collect();
            let text = format!("{{ {} }}", given.join(", "));
            let error = match stage.configure(ValueDeserializer::parse(&text).expect("TOML")) {
                Ok(ready) => return ready,
                Err(error) => error.message().to_owned(),
            };
            let missing = error.strip_prefix("missing field `").and_then(|m| m.strip_suffix('`'));
            keys.push(missing.unwrap_or_else(|| panic!("{}: {error}", stage.info().name)).to_owned());
        }
    }

    /// A square of cloth, 1 m wide, and the size of some mesh.
    fn forecast() -> Forecast {
        let corners = [(0.0, 0.0, 't'), (1000.0, 0.0, 't'), (1000.0, 1000.0, 't'), (0.0, 1000.0, 't')];
        let garment = Garment { pieces: vec![piece(0, "sheet", &corners)], ..Garment::default() };
        Forecast { garment, mesh: Some(MeshSize { triangles: 1000.0, edge: 0.01 }), ..Forecast::default() }
    }

    #[test]
    fn every_stage_foresees_what_it_will_need() {
        for stage in builtin().iter() {
            let ready = with_least_params(stage);
            let (told, _) = lend(|cx| ready.forecast(&mut forecast(), cx));
            // A stage that reads files finds none here, and an error is an answer, too.
            let silent = matches!(told, Ok(None));
            let name = stage.info().name;
            assert!(
                !silent,
                "`{name}` foresees nothing: write its `forecast`, with `Cost::NOTHING` if it costs nothing"
            );
        }
    }

    #[test]
    fn every_knob_is_a_parameter() {
        for stage in builtin().iter() {
            let params = with_least_params(stage).params();
            let mut generator = schemars::SchemaGenerator::default();
            let stage_schema = stage.schema(&mut generator);
            let params_name = stage_schema.as_value()["$ref"].as_str().and_then(|r| r.rsplit('/').next()).unwrap_or("");
            let keys = &generator.definitions()[params_name]["properties"];
            for knob in stage.knobs() {
                // A parameter that is left out while it asks for nothing stands in the schema alone.
                let key = format!("/{}", knob.key.replace('.', "/"));
                let is_known = params.pointer(&key).is_some() || keys.get(knob.key.as_ref()).is_some();
                assert!(is_known, "{} has no {}", stage.info().name, knob.key);
            }
        }
    }
}
