//! The driver, opened a second time: what it is told and what it says.

use std::collections::BTreeMap;
use std::ffi::CStr;
use std::path::Path;

use libloading::{Error, Library};

/// Results of Vulkan that a call can be made to give.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Fault {
    /// One call is told that the device has no memory.
    OutOfMemoryOnce,
    /// So is every call from there on.
    OutOfMemory,
    /// Every call from there on is told that the device is lost.
    Lost,
}

impl Fault {
    pub(crate) const ALL: [Fault; 3] = [Fault::OutOfMemoryOnce, Fault::OutOfMemory, Fault::Lost];

    /// The `VkResult`.
    fn result(self) -> i32 {
        match self {
            Fault::OutOfMemoryOnce | Fault::OutOfMemory => -2,
            Fault::Lost => -4,
        }
    }
}

/// The driver that this process draws with.
pub(crate) struct Steer(Library);

impl Steer {
    /// Opens the library that the loader has open, too: both are one.
    pub(crate) fn open(path: &Path) -> Result<Self, Error> {
        // SAFETY: it is the library of this package, and does nothing when it is opened.
        unsafe { Library::new(path) }.map(Self)
    }

    fn say<T: Copy>(&self, name: &str) -> T {
        // SAFETY: each caller below names a function of `driver.rs` with its type.
        *unsafe { self.0.get::<T>(name.as_bytes()) }
            .unwrap_or_else(|error| panic!("the driver is another one: {error}"))
    }

    /// Lets call number `first` of those that count fail, or all from it on.
    pub(crate) fn plan(&self, first: u64, fault: Fault) {
        let last = match fault {
            Fault::OutOfMemoryOnce => first,
            Fault::OutOfMemory | Fault::Lost => u64::MAX,
        };
        self.say::<extern "C" fn(u64, u64, i32)>("faults_plan")(first, last, fault.result());
    }

    /// Lets calls count, or not.
    pub(crate) fn count(&self, counts: bool) {
        self.say::<extern "C" fn(bool)>("faults_count")(counts);
    }

    /// How many calls counted since the plan.
    pub(crate) fn calls(&self) -> u64 {
        self.say::<extern "C" fn() -> u64>("faults_calls")()
    }

    /// The functions of which calls failed since the plan.
    pub(crate) fn failed(&self) -> Vec<String> {
        let failed = self.say::<extern "C" fn() -> u64>("faults_failed")();
        let names = (0..).map_while(|row| Some((row, self.name(row)?)));
        names
            .filter(|(row, _)| failed >> row & 1 == 1)
            .map(|(_, name)| name)
            .collect()
    }

    /// How many objects there are, by the function that made them.
    pub(crate) fn alive(&self) -> BTreeMap<String, i64> {
        let alive = self.say::<extern "C" fn(usize) -> i64>("faults_alive");
        let names = (0..).map_while(|row| Some((self.name(row)?, alive(row))));
        names.collect()
    }

    fn name(&self, row: usize) -> Option<String> {
        let name = self.say::<extern "C" fn(usize) -> *const u8>("faults_name")(row);
        // SAFETY: the driver keeps the names, and each ends in 0.
        let name = (!name.is_null()).then(|| unsafe { CStr::from_ptr(name.cast()) })?;
        Some(name.to_string_lossy().into_owned())
    }
}
