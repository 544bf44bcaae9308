//! The list of stages a program knows.

use crate::any::AnyStage;
use crate::stage::Stage;

/// Two stages of one name.
#[derive(Debug, thiserror::Error)]
#[error("two stages are called `{0}`")]
pub struct RegistryError(pub String);

/// Stages by name, in the order they were added.
#[derive(Default)]
pub struct Registry {
    stages: Vec<Box<dyn AnyStage>>,
}

impl Registry {
    /// Adds a stage. A second one of the same name is found by [`Self::checked`].
    #[must_use]
    pub fn with(mut self, stage: impl Stage) -> Self {
        self.stages.push(Box::new(stage));
        self
    }

    /// Adds a stage that is already erased, e.g. one in another process.
    ///
    /// # Errors
    /// When the name is taken.
    pub fn add(&mut self, stage: Box<dyn AnyStage>) -> Result<(), RegistryError> {
        let name = stage.info().name.into_owned();
        if self.get(&name).is_some() {
            return Err(RegistryError(name));
        }
        self.stages.push(stage);
        Ok(())
    }

    /// The registry, if no name stands twice.
    ///
    /// # Errors
    /// With the first name that does.
    pub fn checked(self) -> Result<Self, RegistryError> {
        for (i, stage) in self.stages.iter().enumerate() {
            let name = stage.info().name;
            if self.stages[..i].iter().any(|s| s.info().name == name) {
                return Err(RegistryError(name.into_owned()));
            }
        }
        Ok(self)
    }

    /// A stage by name.
    #[must_use]
    pub fn get(&self, name: &str) -> Option<&dyn AnyStage> {
        self.stages.iter().find(|s| s.info().name == name).map(Box::as_ref)
    }

    /// All stages.
    pub fn iter(&self) -> impl Iterator<Item = &dyn AnyStage> {
        self.stages.iter().map(Box::as_ref)
    }
}
