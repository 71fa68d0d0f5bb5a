// SPDX-License-Identifier: GPL-3.0-or-later
//
// Nothing: what is precompiled for the tests needs a target with a source (CMakeLists.txt).
