//! Tuned numbers and mechanisms that can be switched off.
//!
//! A tuned number was chosen by trial; no formula gives it. Every room of the solver lists its numbers in a file of its own,
//! `ROOM/tuning.rs`, by the macro [`tuned!`], and its mechanisms by [`mechanisms!`]. `docs/tuning.md` is generated from these
//! lists. Constants that follow from a formula or a format stay where they are used.
//!
//! A build with the feature `experiments` reads an experiment file, which scales numbers and switches mechanisms off. Any
//! other build has the numbers as they stand here, and every mechanism on.

#[cfg(feature = "experiments")]
pub(crate) mod store;

/// The description of a tuned number, as `docs/tuning.md` shows it.
#[derive(Clone, Copy, Debug)]
pub struct About {
    /// Room of the solver.
    pub room: &'static str,
    /// Name of the number, unique in the package.
    pub name: &'static str,
    /// Meaning of the number: the lines of its documentation.
    pub meaning: &'static [&'static str],
    /// Unit, or what it is a share or a multiple of.
    pub unit: &'static str,
    /// Effect of a larger number.
    pub larger: &'static str,
    /// Effect of a smaller number.
    pub smaller: &'static str,
    /// Range that was tried.
    pub tried: &'static str,
    /// Measurement or argument for this value.
    pub evidence: &'static str,
}

/// A kind of number that an experiment can scale.
pub(crate) trait Scale: Copy {
    /// The number times `factor`. Whole numbers are rounded and stay at least 1.
    #[cfg(feature = "experiments")]
    fn times(self, factor: f64) -> Self;
    /// The number as `f64`, for the table.
    fn as_f64(self) -> f64;
}

macro_rules! whole {
    ($($kind:ty),*) => {$(
        impl Scale for $kind {
            #[cfg(feature = "experiments")]
            #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, clippy::cast_precision_loss)]
            fn times(self, factor: f64) -> Self {
                (self as f64 * factor).round().max(1.0) as Self
            }

            #[allow(clippy::cast_precision_loss, clippy::cast_lossless)]
            fn as_f64(self) -> f64 {
                self as f64
            }
        }
    )*};
}

whole!(u32, u64, usize);

impl Scale for f64 {
    #[cfg(feature = "experiments")]
    fn times(self, factor: f64) -> Self {
        self * factor
    }

    fn as_f64(self) -> f64 {
        self
    }
}

/// A tuned number.
pub(crate) struct Tuned<T> {
    value: T,
    about: About,
    #[cfg(feature = "experiments")]
    scaled: std::sync::OnceLock<T>,
}

impl<T: Scale> Tuned<T> {
    pub const fn new(value: T, about: About) -> Self {
        Self {
            value,
            about,
            #[cfg(feature = "experiments")]
            scaled: std::sync::OnceLock::new(),
        }
    }

    /// The number as this run uses it.
    #[cfg(not(feature = "experiments"))]
    #[inline(always)]
    pub fn get(&self) -> T {
        self.value
    }

    /// The number as this run uses it: scaled where the experiment says so.
    #[cfg(feature = "experiments")]
    #[inline]
    pub fn get(&self) -> T {
        *self.scaled.get_or_init(|| store::factor(self.about.name).map_or(self.value, |f| self.value.times(f)))
    }
}

/// A tuned number of any kind, as the table lists it.
pub(crate) trait Number: Sync {
    fn about(&self) -> &About;
    /// The number that stands in the source.
    fn value(&self) -> f64;
}

impl<T: Scale + Send + Sync> Number for Tuned<T> {
    fn about(&self) -> &About {
        &self.about
    }

    fn value(&self) -> f64 {
        self.value.as_f64()
    }
}

/// A mechanism that an experiment can switch off.
#[derive(Debug)]
pub(crate) struct Mechanism {
    /// Room of the solver.
    pub room: &'static str,
    /// Name in an experiment file, in kebab-case.
    pub name: &'static str,
    /// Task of the mechanism: the lines of its documentation.
    pub task: &'static [&'static str],
}

impl Mechanism {
    /// Does it act in this run?
    #[cfg(not(feature = "experiments"))]
    #[inline(always)]
    #[allow(clippy::unused_self)]
    pub fn is_on(&self) -> bool {
        true
    }

    /// Does it act in this run?
    #[cfg(feature = "experiments")]
    #[inline]
    pub fn is_on(&self) -> bool {
        !store::is_off(self.name)
    }
}

/// Lists the tuned numbers of a room.
macro_rules! tuned {
    (
        room $room:literal;
        $(
            $(#[doc = $meaning:literal])+
            $name:ident: $kind:ty = $value:expr, {
                unit: $unit:literal,
                larger: $larger:literal,
                smaller: $smaller:literal,
                tried: $tried:literal,
                evidence: $evidence:literal $(,)?
            }
        )*
    ) => {
        $(
            $(#[doc = $meaning])+
            pub(crate) static $name: $crate::tuning::Tuned<$kind> = $crate::tuning::Tuned::new(
                $value,
                $crate::tuning::About {
                    room: $room,
                    name: stringify!($name),
                    meaning: &[$($meaning),+],
                    unit: $unit,
                    larger: $larger,
                    smaller: $smaller,
                    tried: $tried,
                    evidence: $evidence,
                },
            );
        )*

        /// All tuned numbers of this room.
        pub(crate) static NUMBERS: &[&dyn $crate::tuning::Number] = &[$(&$name),*];
    };
}

/// Lists the mechanisms of a room that an experiment can switch off.
macro_rules! mechanisms {
    (
        room $room:literal;
        $(
            $(#[doc = $task:literal])+
            $constant:ident = $name:literal;
        )*
    ) => {
        $(
            $(#[doc = $task])+
            pub(crate) static $constant: $crate::tuning::Mechanism =
                $crate::tuning::Mechanism { room: $room, name: $name, task: &[$($task),+] };
        )*

        /// All mechanisms of this room.
        pub(crate) static MECHANISMS: &[&$crate::tuning::Mechanism] = &[$(&$constant),*];
    };
}

pub(crate) use {mechanisms, tuned};
