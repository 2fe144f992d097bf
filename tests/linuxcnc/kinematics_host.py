"""Loads kinematics modules into this process, without HAL and LinuxCNC, to call them many times a second."""

import ctypes
import functools
import os
import re
import subprocess
import tempfile

HERE = os.path.dirname(os.path.abspath(__file__))

Pose = ctypes.c_double * 9
Joints = ctypes.c_double * 16


@functools.cache
def host():
    """The stand-in for HAL, compiled once, and a folder that stays as long."""
    folder = tempfile.TemporaryDirectory(prefix="framepath-host.")
    library = os.path.join(folder.name, "host.so")
    subprocess.run(["cc", "-O1", "-shared", "-fPIC", "-o", library, os.path.join(HERE, "kinematics_host.c")], check=True)
    found = ctypes.CDLL(library, mode=ctypes.RTLD_GLOBAL)
    found.host_find.restype = ctypes.c_void_p
    found.host_find.argtypes = [ctypes.c_char_p]
    found.host_link.argtypes = [ctypes.c_char_p]
    found.host_messages.restype = ctypes.c_char_p
    return found, folder


def copy_for_any(path, copy):
    """Copies a module, which then does not say which LinuxCNC it was built for: this process belongs to the installed one."""
    with open(path, "rb") as file:
        content = file.read()
    with open(copy, "wb") as file:
        file.write(re.sub(rb"(framepath built for LinuxCNC )([^\0]*)", lambda found: found[1] + bytes(len(found[2])), content))


class Module:
    """A kinematics module, loaded with parameters as by loadrt. LoadError if it refuses them."""

    class LoadError(Exception):
        """What the module printed."""

    def __init__(self, path, prefix, beside=None, **parameters):
        """beside: a folder in which it keeps its name, for modules that look for each other."""
        self.host, folder = host()
        self.prefix = prefix
        self.host.host_forget()
        # a copy of its own has variables of its own
        copy = os.path.join(beside or tempfile.mkdtemp(dir=folder.name), os.path.basename(path))
        copy_for_any(path, copy)
        self.library = ctypes.CDLL(copy, mode=ctypes.RTLD_LOCAL)
        # the module keeps the addresses of the texts
        self.texts = {name: ctypes.create_string_buffer(value.encode()) for name, value in parameters.items()}
        for name, text in self.texts.items():
            pointer = ctypes.POINTER(ctypes.c_void_p).in_dll(self.library, f"rtapi_info_address_{name}")
            pointer.contents.value = ctypes.addressof(text)
        if self.library.rtapi_app_main() != 0:
            raise Module.LoadError(self.host.host_messages().decode())
        self.pins = {}
        self.flags = ctypes.c_ulong(0)
        # found now, since the next module makes pins of its own
        self.function = self.find_function()

    def find_function(self):
        return self.host.host_find(f"function {self.prefix}".encode())

    def find(self, pin, kind):
        """To be called for all pins before another module is loaded."""
        address = self.host.host_find(f"{self.prefix}.{pin}".encode())
        if address is None:
            raise KeyError(pin)
        self.pins[pin] = kind.from_address(address)

    def link(self, pin):
        """As a net does it; before the pin is found."""
        self.host.host_link(f"{self.prefix}.{pin}".encode())

    def set(self, **values):
        for name, value in values.items():
            self.pins[name.replace("_", "-")].value = value

    def update(self):
        """One servo period of the module's function."""
        ctypes.CFUNCTYPE(None, ctypes.c_void_p, ctypes.c_long)(self.function)(None, 1000000)

    def switch(self, kinematics_type):
        return self.library.kinematicsSwitch(kinematics_type)

    def forward(self, joints, guess=()):
        pose = Pose(*guess)
        result = self.library.kinematicsForward(Joints(*joints), pose, ctypes.byref(self.flags),
                                                ctypes.byref(self.flags))
        if result:
            raise ArithmeticError(f"kinematicsForward returned {result}")
        return list(pose)

    def inverse(self, pose, near=()):
        joints = Joints(*near)
        result = self.library.kinematicsInverse(Pose(*pose), joints, ctypes.byref(self.flags),
                                                ctypes.byref(self.flags))
        if result:
            raise ArithmeticError(f"kinematicsInverse returned {result}")
        return list(joints)
