//! A module in its file: opened, and its symbols.

use std::ffi::{CStr, CString, c_int};

/// A module that was loaded; it stays loaded.
#[derive(Clone, Copy)]
pub(crate) struct Module(*mut libc::c_void);

impl Module {
    /// With flags of dlopen for whom its functions are there.
    pub(crate) fn open(file: &str, flags: c_int) -> Result<Module, String> {
        let path = CString::new(file).map_err(|error| error.to_string())?;
        // SAFETY: a string that ends with 0.
        let handle = unsafe { libc::dlopen(path.as_ptr(), libc::RTLD_NOW | flags) };
        if handle.is_null() {
            // SAFETY: after a failure there is a text that ends with 0.
            let text = unsafe { CStr::from_ptr(libc::dlerror()) };
            return Err(text.to_string_lossy().into_owned());
        }
        Ok(Module(handle))
    }

    /// The name ends with 0.
    pub(crate) fn symbol(self, name: &str) -> Option<*mut libc::c_void> {
        let name = CStr::from_bytes_with_nul(name.as_bytes()).ok()?;
        // SAFETY: a module that is loaded, a string that ends with 0.
        let address = unsafe { libc::dlsym(self.0, name.as_ptr()) };
        (!address.is_null()).then_some(address)
    }
}
