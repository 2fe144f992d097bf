//! LinuxCNC's own kinematics modules in this process, to be measured beside ours.
#![allow(unsafe_code)]
#![allow(dead_code, reason = "each benchmark uses its own part")]

use std::ffi::{CString, c_char, c_int, c_ulong, c_void};
use std::path::Path;
use std::process::Command;

use framepath::abi::linuxcnc::EmcPose;

type Inverse =
    unsafe extern "C" fn(*const EmcPose, *mut f64, *const c_ulong, *mut c_ulong) -> c_int;
type Forward =
    unsafe extern "C" fn(*const f64, *mut EmcPose, *const c_ulong, *mut c_ulong) -> c_int;

/// A kinematics module, loaded and set up.
pub struct StockKinematics {
    pub inverse: Inverse,
    pub forward: Forward,
}

impl StockKinematics {
    /// Loads `/usr/lib/linuxcnc/modules/NAME.so` with `coordinates=`.
    ///
    /// # Panics
    /// If that is not possible: then there is nothing to compare with.
    pub fn load(name: &str, coordinates: &str) -> Self {
        open(&host(), libc::RTLD_GLOBAL);
        let module = open(
            &format!("/usr/lib/linuxcnc/modules/{name}.so"),
            libc::RTLD_LOCAL,
        );
        let text = CString::new(coordinates).expect("letters").into_raw();
        // SAFETY: LinuxCNC's modules keep the address of each parameter under this name; the text is never freed.
        unsafe {
            let address: *mut *mut *mut c_char =
                symbol(module, "rtapi_info_address_coordinates").cast();
            **address = text;
            let start: extern "C" fn() -> c_int =
                std::mem::transmute(symbol(module, "rtapi_app_main"));
            assert_eq!(start(), 0, "{name} starts");
            Self {
                inverse: std::mem::transmute::<*mut c_void, Inverse>(symbol(
                    module,
                    "kinematicsInverse",
                )),
                forward: std::mem::transmute::<*mut c_void, Forward>(symbol(
                    module,
                    "kinematicsForward",
                )),
            }
        }
    }

    pub fn inverse(&self, world: &EmcPose, joints: &mut [f64; 16]) {
        // SAFETY: as motmod calls it.
        unsafe { (self.inverse)(world, joints.as_mut_ptr(), &0, &mut 0) };
    }

    pub fn forward(&self, joints: &[f64; 16], world: &mut EmcPose) {
        // SAFETY: as motmod calls it.
        unsafe { (self.forward)(joints.as_ptr(), world, &0, &mut 0) };
    }
}

/// Compiles what stands where HAL stands, the same as the tests use.
fn host() -> String {
    let source = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/linuxcnc/kinematics_host.c");
    let library = Path::new(env!("CARGO_TARGET_TMPDIR")).join("kinematics_host.so");
    let done = Command::new("cc")
        .args(["-O1", "-shared", "-fPIC", "-o"])
        .arg(&library)
        .arg(source)
        .status();
    assert!(done.expect("cc runs").success());
    library.to_string_lossy().into_owned()
}

fn open(path: &str, visibility: c_int) -> *mut c_void {
    let name = CString::new(path).expect("a path");
    // SAFETY: a string that ends with 0.
    let library = unsafe { libc::dlopen(name.as_ptr(), libc::RTLD_NOW | visibility) };
    assert!(!library.is_null(), "{path} cannot be loaded");
    library
}

fn symbol(library: *mut c_void, name: &str) -> *mut c_void {
    let name = CString::new(name).expect("a name");
    // SAFETY: a library that was opened, a string that ends with 0.
    let address = unsafe { libc::dlsym(library, name.as_ptr()) };
    assert!(!address.is_null(), "{name:?} is missing");
    address
}
