//! The functions of `stubs.c`, found in this process.

use framepath::abi::linuxcnc::EmcPose;
use std::ffi::{CStr, CString, c_char, c_int, c_long, c_ulong};

/// `struct framepath_host_kinematics` of `stubs.c`.
#[repr(C)]
pub(crate) struct HostKinematics {
    pub forward: unsafe extern "C" fn(*const f64, *mut EmcPose) -> c_int,
    pub inverse: unsafe extern "C" fn(*const EmcPose, *mut f64) -> c_int,
    pub jet: unsafe extern "C" fn(*const f64, *const f64, *mut f64) -> c_int,
    pub axis_of_joint: unsafe extern "C" fn(c_int) -> c_int,
    pub tool_tilt_axis: unsafe extern "C" fn() -> c_int,
}

/// `stubs.c` as a shared object, compiled by the build script.
pub(crate) const STUBS: &[u8] = include_bytes!(concat!(env!("OUT_DIR"), "/stubs.so"));

type SetFlag = unsafe extern "C" fn(c_int);
type SetNumber = unsafe extern "C" fn(c_long);
type SetNamed = unsafe extern "C" fn(*const c_char, f64) -> c_int;
type Count = unsafe extern "C" fn() -> c_ulong;
type Text = unsafe extern "C" fn() -> *const c_char;
type Run = unsafe extern "C" fn();
type SetKinematics = unsafe extern "C" fn(*const HostKinematics);

/// What `stubs.c` offers to the driver.
pub(crate) struct Stubs {
    watch_heap: SetFlag,
    heap_calls: Count,
    first_error: Text,
    errors: Count,
    set_period: SetNumber,
    set: SetNamed,
    put: SetNamed,
    set_kinematics: SetKinematics,
    run_functions: Run,
}

impl Stubs {
    /// `None` if `stubs.c` is not loaded.
    pub(crate) fn find() -> Option<Self> {
        macro_rules! find {
            ($name:literal as $type:ty) => {{
                // SAFETY: a string that ends with 0; the name stands for this type in stubs.c.
                unsafe {
                    let address = libc::dlsym(libc::RTLD_DEFAULT, $name.as_ptr());
                    if address.is_null() {
                        return None;
                    }
                    std::mem::transmute::<*mut libc::c_void, $type>(address)
                }
            }};
        }
        Some(Self {
            watch_heap: find!(c"framepath_host_watch_heap" as SetFlag),
            heap_calls: find!(c"framepath_host_heap_calls" as Count),
            first_error: find!(c"framepath_host_first_error" as Text),
            errors: find!(c"framepath_host_errors" as Count),
            set_period: find!(c"framepath_host_set_period" as SetNumber),
            set: find!(c"framepath_host_set" as SetNamed),
            put: find!(c"framepath_host_put" as SetNamed),
            set_kinematics: find!(c"framepath_host_set_kinematics" as SetKinematics),
            run_functions: find!(c"framepath_host_run_functions" as Run),
        })
    }

    pub(crate) fn watch_heap(&self, on: bool) {
        // SAFETY: sets a number.
        unsafe { (self.watch_heap)(c_int::from(on)) };
    }

    pub(crate) fn heap_calls(&self) -> u64 {
        // SAFETY: reads a number.
        unsafe { (self.heap_calls)() }
    }

    pub(crate) fn errors(&self) -> u64 {
        // SAFETY: reads a number.
        unsafe { (self.errors)() }
    }

    pub(crate) fn first_error(&self) -> String {
        // SAFETY: a text that ends with 0 and stays where it is.
        let text = unsafe { CStr::from_ptr((self.first_error)()) };
        text.to_string_lossy().trim().to_owned()
    }

    pub(crate) fn set_period(&self, nanoseconds: c_long) {
        // SAFETY: sets a number.
        unsafe { (self.set_period)(nanoseconds) };
    }

    /// Sets all pins whose name after that of the component is `ending`; how many there are.
    pub(crate) fn set(&self, ending: &str, value: f64) -> c_int {
        let Ok(ending) = CString::new(ending) else {
            return 0;
        };
        // SAFETY: a string that ends with 0.
        unsafe { (self.set)(ending.as_ptr(), value) }
    }

    /// Sets the pin of this name, if there is one.
    pub(crate) fn put(&self, name: &str, value: f64) {
        if let Ok(name) = CString::new(name) {
            // SAFETY: a string that ends with 0.
            unsafe { (self.put)(name.as_ptr(), value) };
        }
    }

    /// From here on these are the kinematics that modules find.
    pub(crate) fn set_kinematics(&self, kinematics: &'static HostKinematics) {
        // SAFETY: keeps an address of what never goes.
        unsafe { (self.set_kinematics)(kinematics) };
    }

    pub(crate) fn run_functions(&self) {
        // SAFETY: the module exported them for this.
        unsafe { (self.run_functions)() };
    }
}
