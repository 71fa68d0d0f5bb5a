// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

/// Before a function whose loops gain from newer instructions: it is compiled for them as well as for every
/// machine, and the loader takes the one that the machine can run. The results are the same. (Not with
/// sanitizers, whose runtime is not up when the loader chooses, nor with compilers that do not know the
/// levels.)
#if defined(__x86_64__) && defined(__linux__) && defined(__GNUC__) && !defined(__clang__) && \
    __GNUC__ >= 12 && !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#define ARETE_VECTOR_CLONES __attribute__((target_clones("arch=x86-64-v4", "arch=x86-64-v3", "default")))
#else
#define ARETE_VECTOR_CLONES
#endif
