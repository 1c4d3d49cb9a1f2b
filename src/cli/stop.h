// In: Ctrl-C, and the signal by which batch systems end a program (SIGTERM). Out: a flag that the work looks
// at, so that what is done is not lost.
#pragma once

#include <atomic>

namespace sahl {

/// From now on either signal raises the flag; a second one ends the program at once. A signal that the
/// program was started to ignore, in the background of a script, is still ignored.
std::atomic<bool> const& stop_on_signals();

/// The exit status of a program that stopped for the signal that came: 128 and its number.
int status_when_stopped();

} // namespace sahl
