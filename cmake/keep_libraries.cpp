// SPDX-License-Identifier: GPL-3.0-or-later
//
// In programs built with a sanitizer no library is unloaded: of memory that a driver of OpenGL has lost, or
// never gives back, the leak sanitizer can only say whose it is while the driver is there.
extern "C" int dlclose(void*) {
  return 0;
}
