// SPDX-License-Identifier: MIT
// Says: is_among
// A OneOf takes the listed types alone; nothing is converted behind the user's back.
#include <glint/core/one_of.hpp>

struct Matte {};
struct Glass {};
struct Velvet {};

glint::OneOf<Matte, Glass> material{Glass{}};
#ifdef REJECTED
glint::OneOf<Matte, Glass> unlisted{Velvet{}};
#endif
