// SPDX-License-Identifier: MIT
#pragma once

/// The library's only macros. Each may be defined by the user before any glint header is included, alike in every
/// translation unit of a program.

/// GLINT_ASSERT(condition): checks a *Requires* of the documentation. Follows NDEBUG unless replaced.
#ifndef GLINT_ASSERT
#include <cassert>
#define GLINT_ASSERT(condition) assert(condition)
#endif

/// GLINT_ALWAYS_INLINE: for the few leaf functions on which the speed of traversal hangs.
#ifndef GLINT_ALWAYS_INLINE
#if defined(__GNUC__)
#define GLINT_ALWAYS_INLINE [[gnu::always_inline]] inline
#elif defined(_MSC_VER)
#define GLINT_ALWAYS_INLINE __forceinline
#else
#define GLINT_ALWAYS_INLINE inline
#endif
#endif

/// GLINT_NO_INLINE: keeps cold code out of hot loops.
#ifndef GLINT_NO_INLINE
#if defined(__GNUC__)
#define GLINT_NO_INLINE [[gnu::noinline, gnu::cold]]
#else
#define GLINT_NO_INLINE
#endif
#endif

/// GLINT_LARGE_PAGES(address, bytes): asks the system to back memory by its large pages, of which a walk through a
/// large tree touches far fewer. Does nothing where that is unknown.
#ifndef GLINT_LARGE_PAGES
#if defined(__linux__)
#include <sys/mman.h>
#define GLINT_LARGE_PAGES(address, bytes) static_cast<void>(::madvise(address, bytes, MADV_HUGEPAGE))
#else
#define GLINT_LARGE_PAGES(address, bytes) static_cast<void>(0)
#endif
#endif

/// GLINT_PREFETCH(address): has a cache line fetched that will be read soon. It may lie anywhere.
#ifndef GLINT_PREFETCH
#if defined(__GNUC__)
#define GLINT_PREFETCH(address) __builtin_prefetch(address)
#else
#define GLINT_PREFETCH(address) static_cast<void>(address)
#endif
#endif

/// Adds to an unsigned integer that other threads add to as well, and gives what it was. A std::atomic_ref, but for
/// what its header brings: half of all that a small unit with one tree has a compiler read.
#ifndef GLINT_FETCH_ADD
#if defined(__GNUC__)
#define GLINT_FETCH_ADD(number, n) __atomic_fetch_add(&(number), n, __ATOMIC_RELAXED)
#else
#include <atomic>
#define GLINT_FETCH_ADD(number, n) std::atomic_ref(number).fetch_add(n, std::memory_order_relaxed)
#endif
#endif
