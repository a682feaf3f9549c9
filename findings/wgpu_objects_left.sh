#!/usr/bin/env bash
# wgpu 30.0.1 (Vulkan): where the driver has no memory for the second object of a call, the first one is never destroyed, not even with
# the device.
#
# Behaviour seen: a texture that can be drawn to is an image and a view of each of its layers and levels. A driver that has no memory for
# the view is heard: the error scope says that memory is short. But the image stays, and so do views that were made before. In the same
# way the shader module of a pipeline stays, which wgpu makes for the driver and means to destroy at once, where the pipeline is refused.
# A good guess: what an error scope reports has left nothing behind, and whatever belongs to a device goes with it.
# Who meets it: a host that goes on with smaller textures when memory is short, which is what the scope is for: each try keeps an image.
# Output seen (2026-11-30, SwiftShader of chromium-common 156.0.8078.114 behind a driver that refuses one call): texture: out of memory;
# images left 1. pipeline: out of memory; shader modules left 1.
#
# Run by hand: findings/wgpu_objects_left.sh. Needs Debian, cargo and a Vulkan loader. Exits with 0 as long as this is so, with 1 if it has
# changed.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
apt-get download -qq -o APT::Sandbox::User=root chromium-common
ls chromium-common_*.deb
mkdir driver src
dpkg-deb --fsys-tarfile chromium-common_*.deb | tar -x -C driver --wildcards './usr/lib/chromium/*swiftshader*'
cat > Cargo.toml <<'TOML'
[package]
name = "refusing"
version = "0.0.0"
edition = "2024"

[workspace]

[lib]
crate-type = ["cdylib"]

[dependencies]
libloading = "=0.8.9"
pollster = "=0.4.0"
wgpu = { version = "=30.0.1", default-features = false, features = ["std", "vulkan", "wgsl"] }
TOML
# A driver before the other one: it refuses one call, and counts objects.
cat > src/lib.rs <<'RUST'
use libloading::Library;
use std::ffi::{CStr, c_char, c_void};
use std::sync::atomic::{AtomicI64, AtomicUsize, Ordering::SeqCst};

type Find = unsafe extern "C" fn(*mut c_void, *const c_char) -> usize;
type Call = unsafe extern "C" fn(usize, usize, usize, usize, usize, usize) -> i32;

const NAMES: [&CStr; 6] = [
    c"vkCreateImage",
    c"vkDestroyImage",
    c"vkCreateShaderModule",
    c"vkDestroyShaderModule",
    c"vkCreateImageView",
    c"vkCreateComputePipelines",
];
static REAL: [AtomicUsize; 6] = [const { AtomicUsize::new(0) }; 6];
static FIND: AtomicUsize = AtomicUsize::new(0);
const NONE: usize = usize::MAX;
static REFUSED: AtomicUsize = AtomicUsize::new(NONE);
static IMAGES: AtomicI64 = AtomicI64::new(0);
static MODULES: AtomicI64 = AtomicI64::new(0);

unsafe extern "C" fn call<const N: usize>(a: usize, b: usize, c: usize, d: usize, e: usize, f: usize) -> i32 {
    if REFUSED.compare_exchange(N, NONE, SeqCst, SeqCst).is_ok() {
        return -2;
    }
    match N {
        0 => IMAGES.fetch_add(1, SeqCst),
        1 => IMAGES.fetch_sub(1, SeqCst),
        2 => MODULES.fetch_add(1, SeqCst),
        3 => MODULES.fetch_sub(1, SeqCst),
        _ => 0,
    };
    unsafe { std::mem::transmute::<usize, Call>(REAL[N].load(SeqCst))(a, b, c, d, e, f) }
}

fn other() -> &'static Library {
    static OTHER: std::sync::OnceLock<Library> = std::sync::OnceLock::new();
    OTHER.get_or_init(|| unsafe { Library::new(std::env::var_os("OTHER_DRIVER").unwrap()).unwrap() })
}

unsafe fn find(by: &[u8], object: *mut c_void, name: *const c_char) -> usize {
    unsafe { other().get::<Find>(by).unwrap()(object, name) }
}

#[unsafe(no_mangle)]
pub unsafe extern "C" fn vk_icdNegotiateLoaderICDInterfaceVersion(version: *mut u32) -> i32 {
    type Negotiate = unsafe extern "C" fn(*mut u32) -> i32;
    unsafe { other().get::<Negotiate>(b"vk_icdNegotiateLoaderICDInterfaceVersion").unwrap()(version) }
}

#[unsafe(no_mangle)]
pub unsafe extern "C" fn vk_icdGetPhysicalDeviceProcAddr(instance: *mut c_void, name: *const c_char) -> usize {
    unsafe { find(b"vk_icdGetPhysicalDeviceProcAddr", instance, name) }
}

#[unsafe(no_mangle)]
pub unsafe extern "C" fn vk_icdGetInstanceProcAddr(instance: *mut c_void, name: *const c_char) -> usize {
    let real = unsafe { find(b"vk_icdGetInstanceProcAddr", instance, name) };
    if real != 0 && unsafe { CStr::from_ptr(name) } == c"vkGetDeviceProcAddr" {
        FIND.store(real, SeqCst);
        return of_device as Find as usize;
    }
    real
}

unsafe extern "C" fn of_device(device: *mut c_void, name: *const c_char) -> usize {
    let find = unsafe { std::mem::transmute::<usize, Find>(FIND.load(SeqCst)) };
    let (real, name) = unsafe { (find(device, name), CStr::from_ptr(name)) };
    let calls: [Call; 6] = [call::<0>, call::<1>, call::<2>, call::<3>, call::<4>, call::<5>];
    match NAMES.iter().position(|it| *it == name) {
        Some(at) if real != 0 => {
            REAL[at].store(real, SeqCst);
            calls[at] as usize
        }
        _ => real,
    }
}

/// Refuses the next call of a function.
#[unsafe(no_mangle)]
pub extern "C" fn refuse(function: usize) {
    REFUSED.store(function, SeqCst);
}

#[unsafe(no_mangle)]
pub extern "C" fn images() -> i64 {
    IMAGES.load(SeqCst)
}

#[unsafe(no_mangle)]
pub extern "C" fn modules() -> i64 {
    MODULES.load(SeqCst)
}
RUST
cat > src/main.rs <<'RUST'
use pollster::block_on;
use wgpu::*;

const TEXTURE: TextureDescriptor = TextureDescriptor {
    label: None,
    size: Extent3d { width: 64, height: 64, depth_or_array_layers: 1 },
    mip_level_count: 1,
    sample_count: 1,
    dimension: TextureDimension::D2,
    format: TextureFormat::Rgba8Unorm,
    usage: TextureUsages::RENDER_ATTACHMENT,
    view_formats: &[],
};

/// Makes something on a device of its own, while the driver refuses a function's next call, and drops everything.
fn refused(driver: &libloading::Library, function: usize, make: impl FnOnce(&Device)) -> &'static str {
    let instance = Instance::new(InstanceDescriptor::new_without_display_handle());
    let adapter = block_on(instance.request_adapter(&Default::default())).expect("an adapter");
    let (device, _queue) = block_on(adapter.request_device(&Default::default())).expect("a device");
    unsafe { driver.get::<extern "C" fn(usize)>(b"refuse").unwrap()(function) };
    let scope = device.push_error_scope(ErrorFilter::OutOfMemory);
    make(&device);
    match block_on(scope.pop()) {
        Some(Error::OutOfMemory { .. }) => "out of memory",
        _ => "no error",
    }
}

fn main() {
    let driver = unsafe { libloading::Library::new(std::env::var_os("OWN_DRIVER").unwrap()).unwrap() };
    let count = |name: &str| unsafe { driver.get::<extern "C" fn() -> i64>(name.as_bytes()).unwrap()() };
    refused(&driver, usize::MAX, |device| drop(device.create_texture(&TEXTURE)));
    println!("without a refusal: images left {}, shader modules left {}", count("images"), count("modules"));
    let said = refused(&driver, 4, |device| drop(device.create_texture(&TEXTURE)));
    println!("texture: {said}; images left {}", count("images"));
    let said = refused(&driver, 5, |device| {
        let source = ShaderSource::Wgsl("@compute @workgroup_size(1) fn main() {}".into());
        let module = device.create_shader_module(ShaderModuleDescriptor { label: None, source });
        drop(device.create_compute_pipeline(&ComputePipelineDescriptor {
            label: None,
            layout: None,
            module: &module,
            entry_point: None,
            compilation_options: Default::default(),
            cache: None,
        }));
    });
    println!("pipeline: {said}; shader modules left {}", count("modules"));
}
RUST
CARGO_TARGET_DIR=target cargo build --quiet --release
printf '{"file_format_version": "1.0.0", "ICD": {"library_path": "%s/target/release/librefusing.so", "api_version": "1.1.0"}}\n' "$folder" > own.json
export VK_DRIVER_FILES=$folder/own.json VK_ICD_FILENAMES=$folder/own.json OWN_DRIVER=$folder/target/release/librefusing.so
export OTHER_DRIVER=$folder/driver/usr/lib/chromium/libvk_swiftshader.so
found=$(./target/release/refusing)
echo "$found"
expected='without a refusal: images left 0, shader modules left 0
texture: out of memory; images left 1
pipeline: out of memory; shader modules left 1'
if [ "$found" = "$expected" ]; then
  echo 'As described: refused halfway, wgpu leaves what it had made.'
else
  echo 'It has changed.'
  exit 1
fi
