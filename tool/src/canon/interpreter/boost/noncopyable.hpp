/* The one thing of Boost that LinuxCNC's interp_base.hh asks for; with it Boost need not be installed.
 *
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#ifndef FRAMEPATH_NONCOPYABLE
#define FRAMEPATH_NONCOPYABLE

namespace boost {
class noncopyable {
protected:
    noncopyable() = default;
    noncopyable(const noncopyable &) = delete;
    noncopyable &operator=(const noncopyable &) = delete;
};
}

#endif
