/* Python that stands in a program (";py,.." and "(py,..)"): the interpreter would run whatever stands there, at once. A plan
 * only reads, so it is refused.
 *
 * The interpreter's library has the plugin do it, which is in a library of its own (libpyplugin): the function here stands before
 * that of the library, since the dynamic linker looks into the program first. What else goes through the plugin, the remaps of
 * the machine, has other functions.
 *
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include <dlfcn.h>
#include "calls.hh"

namespace boost {
namespace python {
namespace api {
class object;
}
}
}

class PythonPlugin {
public:
    int run_string(const char *code, boost::python::api::object &result, bool as_file);
};

typedef int (*RunString)(PythonPlugin *, const char *, boost::python::api::object *, bool);

static bool allowed = true;

void refuse_python()
{
    allowed = false;
}

/* The interpreter imports its own module with it when it is made. 0: done. */
int PythonPlugin::run_string(const char *code, boost::python::api::object &result, bool as_file)
{
    static void *found = dlsym(RTLD_NEXT, "_ZN12PythonPlugin10run_stringEPKcRN5boost6python3api6objectEb");
    if (allowed && found)
        return reinterpret_cast<RunString>(found)(this, code, &result, as_file);
    refuse_call("Python in a program (;py,.. or (py,..); leave it out of what is planned, which is read only)");
    return 0;
}
