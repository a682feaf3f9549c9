//! A Vulkan driver that stands before another one and says what a call of it gave, but for those that it was told to fail.
//!
//! It is for one test program in the same process, which steers it through the functions at the end, and for 64-bit systems. The
//! other driver's library is named by the environment variable `FAULTS_DRIVER`.

use std::ffi::{CStr, c_char, c_void};
use std::sync::OnceLock;
use std::sync::atomic::{AtomicI64, AtomicU32, AtomicU64, AtomicUsize, Ordering::SeqCst};

/// Integers and pointers alone: six of them fit every function here, and those that take fewer ignore the rest.
type Call = unsafe extern "C" fn(usize, usize, usize, usize, usize, usize) -> i32;
type Undo = unsafe extern "C" fn(usize, u64, usize);
type Function = unsafe extern "C" fn();
type Find = unsafe extern "C" fn(*mut c_void, *const c_char) -> Option<Function>;

/// A function that can fail, and the one that undoes it, if one of its own does.
struct Row {
    name: &'static str,
    undo: &'static str,
    call: Call,
    undone: Undo,
}

macro_rules! rows {
    ($($number:literal $name:literal $undo:literal;)*) => {
        &[$(Row { name: $name, undo: $undo, call: call::<$number>, undone: undone::<$number> }),*]
    };
}

const ROWS: &[Row] = rows! {
    0 "vkAllocateMemory" "vkFreeMemory";
    1 "vkCreateBuffer" "vkDestroyBuffer";
    2 "vkCreateImage" "vkDestroyImage";
    3 "vkCreateImageView" "vkDestroyImageView";
    4 "vkCreateSampler" "vkDestroySampler";
    5 "vkCreateShaderModule" "vkDestroyShaderModule";
    6 "vkCreateDescriptorSetLayout" "vkDestroyDescriptorSetLayout";
    7 "vkCreatePipelineLayout" "vkDestroyPipelineLayout";
    8 "vkCreateDescriptorPool" "vkDestroyDescriptorPool";
    9 "vkCreateComputePipelines" "vkDestroyPipeline";
    10 "vkCreateGraphicsPipelines" "vkDestroyPipeline";
    11 "vkCreateRenderPass" "vkDestroyRenderPass";
    12 "vkCreateFramebuffer" "vkDestroyFramebuffer";
    13 "vkCreateCommandPool" "vkDestroyCommandPool";
    14 "vkCreateFence" "vkDestroyFence";
    15 "vkCreateSemaphore" "vkDestroySemaphore";
    16 "vkCreateQueryPool" "vkDestroyQueryPool";
    17 "vkAllocateDescriptorSets" "";
    18 "vkAllocateCommandBuffers" "";
    19 "vkBeginCommandBuffer" "";
    20 "vkEndCommandBuffer" "";
    21 "vkBindBufferMemory" "";
    22 "vkBindImageMemory" "";
    23 "vkMapMemory" "";
    24 "vkQueueSubmit" "";
    25 "vkGetSemaphoreCounterValue" "";
    26 "vkWaitSemaphores" "";
};

const COUNT: usize = ROWS.len();

static CALLS: [AtomicUsize; COUNT] = [const { AtomicUsize::new(0) }; COUNT];
static UNDOS: [AtomicUsize; COUNT] = [const { AtomicUsize::new(0) }; COUNT];
static ALIVE: [AtomicI64; COUNT] = [const { AtomicI64::new(0) }; COUNT];
static FIND_OF_DEVICE: AtomicUsize = AtomicUsize::new(0);

/// Calls while faults are counted, the first and the last of them to fail, and with what.
static NUMBER: AtomicU64 = AtomicU64::new(0);
static FIRST: AtomicU64 = AtomicU64::new(u64::MAX);
static LAST: AtomicU64 = AtomicU64::new(0);
static RESULT: AtomicU32 = AtomicU32::new(0);
static COUNTS: AtomicU32 = AtomicU32::new(0);
/// A bit for each row of which a call was made to fail.
static FAILED: AtomicU64 = AtomicU64::new(0);

/// The row that objects of a row are counted in: the first with the same undoing.
fn counted(row: usize) -> usize {
    let same = ROWS.iter().position(|it| it.undo == ROWS[row].undo);
    same.unwrap_or(row)
}

unsafe extern "C" fn call<const ROW: usize>(
    a: usize,
    b: usize,
    c: usize,
    d: usize,
    e: usize,
    f: usize,
) -> i32 {
    if COUNTS.load(SeqCst) == 1 {
        let number = NUMBER.fetch_add(1, SeqCst);
        if (FIRST.load(SeqCst)..=LAST.load(SeqCst)).contains(&number) {
            FAILED.fetch_or(1 << ROW, SeqCst);
            return RESULT.load(SeqCst).cast_signed();
        }
    }
    // SAFETY: the other driver gave this function under the name of this row; it is called with what the caller gave.
    let result = unsafe {
        let real: Call = std::mem::transmute(CALLS[ROW].load(SeqCst));
        real(a, b, c, d, e, f)
    };
    if result == 0 && !ROWS[ROW].undo.is_empty() {
        ALIVE[counted(ROW)].fetch_add(1, SeqCst);
    }
    result
}

unsafe extern "C" fn undone<const ROW: usize>(device: usize, object: u64, allocator: usize) {
    if object != 0 {
        ALIVE[counted(ROW)].fetch_sub(1, SeqCst);
    }
    // SAFETY: as above.
    unsafe {
        let real: Undo = std::mem::transmute(UNDOS[ROW].load(SeqCst));
        real(device, object, allocator);
    }
}

/// Puts a function of this driver in place of that of the other one, where a row has it.
fn replaced(name: &CStr, real: Option<Function>) -> Option<Function> {
    let real = real?;
    let Ok(name) = name.to_str() else {
        return Some(real);
    };
    for (row, it) in ROWS.iter().enumerate() {
        if it.name == name {
            CALLS[row].store(real as usize, SeqCst);
            // SAFETY: the loader calls it by its name, so with its own arguments.
            return Some(unsafe { std::mem::transmute::<Call, Function>(it.call) });
        }
        if it.undo == name {
            UNDOS[row].store(real as usize, SeqCst);
            // SAFETY: the same.
            return Some(unsafe { std::mem::transmute::<Undo, Function>(it.undone) });
        }
    }
    Some(real)
}

/// The other driver; nothing if there is none.
fn other() -> Option<&'static libloading::Library> {
    static OTHER: OnceLock<Option<libloading::Library>> = OnceLock::new();
    let open = || {
        let path = std::env::var_os("FAULTS_DRIVER")?;
        // SAFETY: it is a driver that the system trusts, and loads in the same way.
        unsafe { libloading::Library::new(path) }.ok()
    };
    OTHER.get_or_init(open).as_ref()
}

/// # Safety
/// `name` is the name of a function, ending in 0.
unsafe fn found(entry: &str, object: *mut c_void, name: *const c_char) -> Option<Function> {
    // SAFETY: both functions have this signature in the loader's interface for drivers.
    unsafe {
        let find = other()?.get::<Find>(entry.as_bytes()).ok()?;
        find(object, name)
    }
}

/// Says which version of the loader's interface the other driver has.
///
/// # Safety
/// `version` points to a number.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn vk_icdNegotiateLoaderICDInterfaceVersion(version: *mut u32) -> i32 {
    const INITIALIZATION_FAILED: i32 = -3;
    type Negotiate = unsafe extern "C" fn(*mut u32) -> i32;
    let entry = b"vk_icdNegotiateLoaderICDInterfaceVersion";
    // SAFETY: the function has this signature in the loader's interface for drivers.
    match other().and_then(|other| unsafe { other.get::<Negotiate>(entry) }.ok()) {
        Some(negotiate) => unsafe { negotiate(version) },
        None => INITIALIZATION_FAILED,
    }
}

/// Finds a function of an instance.
///
/// # Safety
/// As Vulkan has it.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn vk_icdGetInstanceProcAddr(
    instance: *mut c_void,
    name: *const c_char,
) -> Option<Function> {
    // SAFETY: the loader gives a name that ends in 0.
    let (real, name) = unsafe {
        (
            found("vk_icdGetInstanceProcAddr", instance, name),
            CStr::from_ptr(name),
        )
    };
    if name == c"vkGetDeviceProcAddr" {
        FIND_OF_DEVICE.store(real? as usize, SeqCst);
        // SAFETY: the loader calls it by its name, so with its own arguments.
        return Some(unsafe { std::mem::transmute::<Find, Function>(find_of_device) });
    }
    replaced(name, real)
}

/// Finds a function of a physical device.
///
/// # Safety
/// As Vulkan has it.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn vk_icdGetPhysicalDeviceProcAddr(
    instance: *mut c_void,
    name: *const c_char,
) -> Option<Function> {
    // SAFETY: the loader gives a name that ends in 0.
    unsafe { found("vk_icdGetPhysicalDeviceProcAddr", instance, name) }
}

unsafe extern "C" fn find_of_device(device: *mut c_void, name: *const c_char) -> Option<Function> {
    // SAFETY: it was stored before the loader had this function.
    unsafe {
        let find: Find = std::mem::transmute(FIND_OF_DEVICE.load(SeqCst));
        replaced(CStr::from_ptr(name), find(device, name))
    }
}

/// Lets the calls from number `first` to number `last` fail with a `VkResult`. Calls are numbered from 0 from here on, while
/// [`faults_count`] says so.
#[unsafe(no_mangle)]
pub extern "C" fn faults_plan(first: u64, last: u64, result: i32) {
    NUMBER.store(0, SeqCst);
    FIRST.store(first, SeqCst);
    LAST.store(last, SeqCst);
    RESULT.store(result.cast_unsigned(), SeqCst);
    FAILED.store(0, SeqCst);
}

/// Whether calls are numbered, and so can fail, from now on.
#[unsafe(no_mangle)]
pub extern "C" fn faults_count(counts: bool) {
    COUNTS.store(u32::from(counts), SeqCst);
}

/// How many calls were numbered.
#[unsafe(no_mangle)]
pub extern "C" fn faults_calls() -> u64 {
    NUMBER.load(SeqCst)
}

/// A bit for each row of which a call was made to fail since the plan.
#[unsafe(no_mangle)]
pub extern "C" fn faults_failed() -> u64 {
    FAILED.load(SeqCst)
}

/// How many objects of a row there are.
#[unsafe(no_mangle)]
pub extern "C" fn faults_alive(row: usize) -> i64 {
    ALIVE.get(row).map_or(0, |alive| alive.load(SeqCst))
}

/// The name of a row, ending in 0; null behind the last one.
#[unsafe(no_mangle)]
pub extern "C" fn faults_name(row: usize) -> *const u8 {
    static NAMES: OnceLock<Vec<String>> = OnceLock::new();
    let names = NAMES.get_or_init(|| ROWS.iter().map(|it| format!("{}\0", it.name)).collect());
    names
        .get(row)
        .map_or(std::ptr::null(), |name| name.as_ptr())
}
