// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include <glint/bsdf/microfacet.hpp>

/// How much light leaves a rough surface after it has met one facet: tables over roughness and angle.
namespace glint {

namespace detail {

inline constexpr std::size_t albedo_steps = 19;

/// One roughness; columns are √cos θ in equal steps.
using AlbedoRow = std::array<float, albedo_steps + 1>;

/// Rows are √alpha in equal steps.
using AlbedoGrid = std::array<AlbedoRow, albedo_steps + 1>;

/// From units of 1e-4.
[[nodiscard]] constexpr AlbedoGrid albedo_grid(const std::array<int, 400>& values) noexcept {
  AlbedoGrid grid{};
  for (std::size_t i = 0; i < values.size(); ++i) grid[i / 20][i % 20] = 1e-4F * static_cast<float>(values[i]);
  return grid;
}

/// What facets that reflect everything lose, since other facets hide it. A distribution joins by a specialization of
/// this and the next.
template <MicrofacetDistribution D>
inline constexpr AlbedoGrid missing_albedo{};

/// What facets with the reflectance (F − F₀) / (1 − F₀) reflect, F being Fresnel's for an index of 1.5.
template <MicrofacetDistribution D>
inline constexpr AlbedoGrid edge_albedo{};

template <>
inline constexpr AlbedoGrid missing_albedo<Ggx> = albedo_grid(
    {0,    0,    0,    0,    0,    0,    0,    0,    0,    0,    0,    0,    0,    0,    0,    0,    0,    0,    0,
     0,    75,   1079, 355,  73,   22,   9,    4,    2,    1,    1,    1,    0,    0,    0,    0,    0,    0,    0,
     0,    0,    19,   475,  1080, 779,  355,  154,  73,   39,   22,   14,   9,    6,    5,    4,    3,    2,    2,
     2,    1,    1,    8,    227,  753,  1085, 946,  618,  359,  206,  122,  76,   50,   35,   25,   19,   15,   12,
     10,   8,    7,    6,    5,    134,  485,  887,  1096, 1026, 795,  554,  369,  246,  166,  116,  84,   63,   49,
     39,   32,   27,   24,   21,   3,    91,   338,  671,  972,  1121, 1084, 921,  719,  535,  391,  286,  213,  162,
     126,  101,  83,   70,   61,   54,   3,    70,   258,  527,  817,  1051, 1165, 1147, 1031, 867,  698,  550,  431,
     339,  270,  219,  181,  153,  132,  116,  2,    60,   217,  442,  703,  953,  1142, 1237, 1232, 1148, 1016, 868,
     725,  600,  496,  412,  347,  296,  257,  226,  2,    57,   198,  399,  637,  881,  1100, 1261, 1345, 1351, 1291,
     1186, 1058, 926,  801,  691,  596,  518,  455,  403,  3,    58,   194,  385,  611,  850,  1079, 1276, 1420, 1501,
     1517, 1477, 1395, 1287, 1167, 1047, 935,  833,  745,  670,  3,    61,   201,  393,  617,  856,  1094, 1312, 1496,
     1632, 1713, 1741, 1719, 1658, 1570, 1465, 1354, 1243, 1138, 1042, 3,    67,   216,  416,  648,  895,  1144, 1381,
     1594, 1772, 1907, 1994, 2034, 2032, 1992, 1925, 1837, 1738, 1633, 1529, 4,    75,   238,  453,  700,  962,  1228,
     1485, 1725, 1937, 2115, 2255, 2352, 2409, 2427, 2411, 2366, 2299, 2216, 2124, 4,    84,   265,  500,  768,  1052,
     1340, 1621, 1888, 2133, 2350, 2535, 2684, 2796, 2873, 2914, 2924, 2907, 2865, 2806, 5,    95,   296,  556,  850,
     1161, 1476, 1786, 2083, 2360, 2613, 2839, 3035, 3199, 3330, 3429, 3498, 3538, 3552, 3543, 6,    107,  331,  619,
     944,  1286, 1633, 1975, 2304, 2615, 2904, 3168, 3406, 3616, 3798, 3951, 4077, 4175, 4249, 4298, 6,    119,  369,
     689,  1047, 1425, 1806, 2183, 2546, 2892, 3217, 3518, 3795, 4046, 4272, 4473, 4649, 4801, 4930, 5038, 7,    133,
     410,  764,  1159, 1574, 1993, 2406, 2806, 3187, 3547, 3883, 4196, 4484, 4747, 4988, 5206, 5402, 5577, 5734, 8,
     148,  454,  843,  1277, 1731, 2189, 2641, 3077, 3494, 3888, 4257, 4601, 4921, 5216, 5488, 5738, 5967, 6177, 6368,
     9,    163,  500,  926,  1400, 1895, 2394, 2883, 3356, 3807, 4233, 4633, 5005, 5351, 5671, 5966, 6238, 6489, 6719,
     6931});

template <>
inline constexpr AlbedoGrid edge_albedo<Ggx> = albedo_grid(
    {9994, 9834, 9353, 8608, 7671, 6624, 5546, 4504, 3547, 2707, 1998, 1421, 970, 630, 384, 214, 105, 40, 9,  0,
     9241, 8428, 8897, 8490, 7627, 6604, 5536, 4499, 3544, 2705, 1997, 1421, 970, 630, 384, 214, 105, 40, 9,  0,
     8094, 7810, 7403, 7409, 7101, 6354, 5411, 4435, 3511, 2689, 1990, 1419, 970, 631, 385, 215, 105, 41, 9,  0,
     6842, 6733, 6444, 6176, 5979, 5612, 4985, 4202, 3388, 2626, 1959, 1406, 966, 631, 387, 217, 107, 42, 9,  0,
     5680, 5622, 5450, 5205, 4948, 4665, 4272, 3738, 3114, 2474, 1881, 1369, 952, 628, 388, 220, 110, 44, 10, 0,
     4668, 4630, 4514, 4328, 4095, 3832, 3527, 3154, 2708, 2221, 1736, 1294, 918, 616, 387, 223, 114, 47, 12, 1,
     3820, 3791, 3703, 3560, 3369, 3142, 2885, 2595, 2266, 1906, 1533, 1176, 857, 589, 379, 224, 118, 51, 14, 1,
     3124, 3100, 3029, 2913, 2758, 2569, 2354, 2118, 1862, 1589, 1306, 1028, 770, 545, 361, 220, 120, 54, 17, 2,
     2562, 2541, 2481, 2384, 2255, 2099, 1921, 1726, 1520, 1306, 1088, 873,  670, 488, 333, 210, 119, 57, 20, 3,
     2112, 2094, 2041, 1958, 1849, 1718, 1569, 1408, 1239, 1067, 895,  727,  568, 423, 297, 194, 114, 57, 22, 4,
     1754, 1737, 1690, 1618, 1523, 1411, 1286, 1152, 1012, 872,  733,  600,  474, 359, 258, 173, 106, 56, 23, 5,
     1470, 1454, 1411, 1346, 1264, 1167, 1059, 946,  829,  713,  600,  492,  392, 300, 220, 151, 95,  53, 23, 6,
     1244, 1229, 1190, 1131, 1057, 971,  878,  781,  682,  585,  492,  404,  322, 249, 184, 129, 84,  48, 23, 6,
     1065, 1051, 1013, 959,  892,  815,  734,  649,  565,  482,  404,  331,  265, 205, 153, 109, 72,  43, 21, 7,
     923,  909,  872,  821,  759,  690,  617,  543,  470,  399,  333,  272,  217, 168, 126, 90,  61,  37, 19, 7,
     810,  795,  759,  711,  653,  590,  524,  458,  393,  332,  276,  224,  178, 138, 104, 75,  51,  32, 17, 7,
     719,  704,  668,  621,  567,  508,  448,  388,  331,  278,  229,  185,  147, 114, 85,  61,  42,  27, 15, 6,
     646,  630,  595,  549,  497,  441,  386,  332,  281,  234,  191,  154,  121, 93,  70,  50,  35,  22, 13, 6,
     586,  570,  535,  489,  439,  387,  335,  285,  240,  198,  161,  128,  100, 77,  57,  41,  29,  18, 11, 5,
     539,  522,  486,  440,  391,  341,  293,  247,  205,  168,  135,  107,  83,  63,  47,  34,  23,  15, 9,  4});

template <>
inline constexpr AlbedoGrid missing_albedo<Beckmann> = albedo_grid(
    {0,  0,   0,   0,   0,   0,   0,   0,   0,   0,    0,    0,    0,    0,    0,    0,    0,    0,    0,    0,
     73, 857, 25,  0,   0,   0,   0,   0,   0,   0,    0,    0,    0,    0,    0,    0,    0,    0,    0,    0,
     19, 432, 857, 375, 25,  0,   0,   0,   0,   0,    0,    0,    0,    0,    0,    0,    0,    0,    0,    0,
     8,  214, 653, 858, 591, 194, 25,  1,   0,   0,    0,    0,    0,    0,    0,    0,    0,    0,    0,    0,
     4,  125, 433, 745, 860, 693, 376, 128, 24,  2,    0,    0,    0,    0,    0,    0,    0,    0,    0,    0,
     3,  81,  298, 570, 792, 864, 750, 508, 259, 95,   23,   3,    0,    0,    0,    0,    0,    0,    0,    0,
     2,  57,  216, 436, 659, 821, 871, 788, 602, 379,  191,  74,   20,   4,    0,    0,    0,    0,    0,    0,
     1,  43,  163, 340, 539, 721, 846, 883, 820, 673,  480,  291,  146,  57,   16,   3,    0,    0,    0,    0,
     1,  33,  128, 272, 444, 619, 770, 871, 901, 854,  735,  568,  386,  226,  109,  40,   10,   1,    0,    0,
     1,  26,  104, 223, 371, 532, 687, 816, 901, 930,  894,  796,  649,  478,  309,  169,  72,   20,   3,    0,
     1,  22,  86,  187, 316, 462, 611, 750, 865, 942,  971,  946,  864,  734,  570,  394,  231,  105,  28,   1,
     0,  19,  74,  161, 275, 407, 549, 689, 817, 923,  997,  1030, 1015, 948,  830,  670,  483,  293,  126,  14,
     0,  16,  65,  142, 244, 365, 499, 637, 771, 895,  999,  1075, 1115, 1112, 1059, 950,  788,  581,  344,  101,
     0,  15,  58,  128, 222, 335, 461, 596, 734, 868,  992,  1100, 1185, 1237, 1250, 1211, 1111, 941,  697,  372,
     0,  13,  54,  119, 207, 313, 435, 568, 708, 850,  990,  1122, 1241, 1342, 1415, 1451, 1435, 1349, 1177, 905,
     0,  13,  51,  113, 197, 300, 420, 553, 696, 846,  999,  1152, 1302, 1444, 1574, 1685, 1765, 1798, 1770, 1681,
     0,  12,  49,  110, 193, 295, 416, 551, 699, 858,  1025, 1200, 1379, 1562, 1748, 1935, 2119, 2294, 2455, 2610,
     0,  12,  49,  110, 194, 298, 422, 563, 720, 891,  1076, 1274, 1486, 1714, 1959, 2226, 2520, 2845, 3202, 3587,
     0,  13,  51,  114, 200, 309, 440, 590, 760, 949,  1157, 1385, 1636, 1914, 2225, 2577, 2981, 3447, 3972, 4528,
     0,  13,  54,  120, 212, 330, 471, 636, 824, 1036, 1274, 1540, 1838, 2174, 2557, 2996, 3504, 4086, 4729, 5384});

template <>
inline constexpr AlbedoGrid edge_albedo<Beckmann> = albedo_grid(
    {9994, 9834, 9353, 8608, 7671, 6624, 5546, 4504, 3547, 2707, 1998, 1421, 970, 630, 384, 214, 105, 40, 9,  0,
     9777, 8911, 9310, 8601, 7668, 6623, 5545, 4504, 3547, 2707, 1998, 1421, 970, 630, 384, 214, 105, 40, 9,  0,
     9408, 8933, 8256, 8143, 7595, 6597, 5533, 4497, 3544, 2705, 1997, 1421, 970, 630, 384, 214, 105, 40, 9,  0,
     8768, 8508, 7882, 7291, 6879, 6330, 5459, 4469, 3531, 2700, 1996, 1422, 971, 631, 385, 215, 105, 41, 9,  0,
     7962, 7795, 7334, 6738, 6158, 5629, 5043, 4309, 3482, 2685, 1992, 1422, 974, 634, 387, 217, 106, 41, 9,  0,
     7070, 6952, 6609, 6116, 5556, 4995, 4449, 3882, 3262, 2604, 1972, 1422, 978, 639, 392, 220, 109, 42, 10, 0,
     6161, 6072, 5812, 5417, 4939, 4424, 3908, 3402, 2897, 2384, 1874, 1395, 980, 648, 400, 226, 113, 45, 11, 0,
     5288, 5220, 5018, 4704, 4311, 3870, 3413, 2961, 2522, 2098, 1690, 1303, 950, 649, 410, 236, 119, 49, 12, 0,
     4487, 4435, 4275, 4026, 3706, 3340, 2951, 2560, 2179, 1818, 1479, 1164, 876, 623, 411, 246, 129, 55, 15, 0,
     3780, 3738, 3611, 3411, 3152, 2851, 2527, 2196, 1871, 1563, 1276, 1015, 779, 571, 393, 248, 138, 62, 19, 1,
     3171, 3137, 3035, 2873, 2662, 2416, 2147, 1871, 1597, 1337, 1094, 874,  678, 507, 359, 237, 140, 69, 24, 2,
     2658, 2631, 2548, 2415, 2243, 2040, 1817, 1587, 1358, 1138, 934,  749,  584, 441, 319, 218, 136, 73, 29, 4,
     2232, 2210, 2141, 2032, 1889, 1721, 1536, 1344, 1152, 967,  795,  639,  500, 380, 278, 194, 125, 72, 32, 6,
     1883, 1864, 1807, 1716, 1596, 1455, 1300, 1138, 977,  821,  676,  543,  426, 325, 240, 169, 112, 67, 33, 9,
     1598, 1582, 1534, 1457, 1355, 1236, 1104, 967,  830,  698,  574,  462,  363, 277, 205, 146, 98,  61, 32, 11,
     1367, 1354, 1312, 1245, 1158, 1055, 942,  825,  707,  594,  488,  393,  308, 236, 175, 125, 85,  53, 30, 12,
     1180, 1168, 1132, 1073, 997,  907,  809,  707,  605,  507,  416,  334,  262, 200, 148, 106, 72,  46, 26, 12,
     1029, 1018, 985,  934,  866,  786,  699,  609,  520,  434,  355,  284,  222, 169, 125, 89,  61,  39, 23, 11,
     906,  896,  866,  819,  758,  687,  609,  528,  449,  373,  304,  242,  188, 143, 105, 75,  51,  33, 20, 10,
     805,  797,  769,  726,  670,  605,  534,  461,  390,  322,  261,  206,  159, 120, 88,  62,  43,  28, 17, 9});

/// 2 ∫ cos d(cos) of each row as it is interpolated: linear in x = √cos, so that the weight is 4 x³ dx.
[[nodiscard]] constexpr AlbedoRow mean_albedo(const AlbedoGrid& grid) noexcept {
  constexpr double step = 1.0 / albedo_steps;
  AlbedoRow means{};
  for (std::size_t i = 0; i < albedo_steps; ++i) {
    const double a = static_cast<double>(i) * step;
    const double b = a + step;
    const double mass = b * b * b * b - a * a * a * a;
    const double moment = (0.8 * (b * b * b * b * b - a * a * a * a * a) - a * mass) / step;  // of (x − a) / step
    const auto left = static_cast<float>(mass - moment);
    const auto right = static_cast<float>(moment);
    for (std::size_t row = 0; row <= albedo_steps; ++row) means[row] += grid[row][i] * left + grid[row][i + 1] * right;
  }
  return means;
}

template <MicrofacetDistribution D>
inline constexpr AlbedoRow mean_missing_albedo = mean_albedo(missing_albedo<D>);
template <MicrofacetDistribution D>
inline constexpr AlbedoRow mean_edge_albedo = mean_albedo(edge_albedo<D>);

/// Where a value in [0, 1] lies between the entries of a table.
struct AlbedoPlace {
  std::size_t index = 0;
  float share = 0;

  explicit AlbedoPlace(float value) noexcept {
    const float x = static_cast<float>(albedo_steps) * std::sqrt(std::min(value, 1.0F));
    index = std::min(static_cast<std::size_t>(x), albedo_steps - 1);
    share = x - static_cast<float>(index);
  }

  [[nodiscard]] float in(const AlbedoRow& row) const noexcept {
    return row[index] + share * (row[index + 1] - row[index]);
  }
};

}  // namespace detail

/// What a rough surface reflects of the light from a direction, after one bounce: the directional albedo, at one
/// roughness.
///
/// Facets of a dielectric reflect F₀ (1 − missing) + (1 − F₀) edge, where F₀ is what they reflect straight on: exact
/// for an index of 1.5, and close for those of plastics, varnish and glass. An anisotropic distribution counts as the
/// isotropic one of the same mean roughness.
///
/// Shapes:   cosines in [0, 1]; alpha above one counts as one.
/// Ensures:  within 0.01 for isotropic distributions of alpha ≥ 0.05.
/// Cost:     a root each to build it and to look something up; no state beyond one number of the roughness.
/// Source:   tables of this kind: Kulla, Conty, "Revisiting Physically Based Shading at Imageworks", SIGGRAPH course
///           Physically Based Shading in Theory and Practice, 2017.
template <MicrofacetDistribution D>
class DirectionalAlbedo {
 public:
  explicit DirectionalAlbedo(const D& d) noexcept : row_(std::sqrt(d.alpha_x * d.alpha_y)) {}

  /// What facets that reflect everything lose.
  [[nodiscard]] float missing(float cos) const noexcept {
    return interpolated(detail::missing_albedo<D>, detail::AlbedoPlace{cos});
  }

  /// The mean of `missing` over the hemisphere, by the cosine: exact, of the interpolated table.
  [[nodiscard]] float mean_missing() const noexcept { return row_.in(detail::mean_missing_albedo<D>); }

  /// What facets of a dielectric reflect.
  [[nodiscard]] float dielectric(float cos, float at_normal) const noexcept {
    const detail::AlbedoPlace place{cos};
    const float edge = interpolated(detail::edge_albedo<D>, place);
    return edge + at_normal * (1.0F - interpolated(detail::missing_albedo<D>, place) - edge);
  }

  /// The mean of `dielectric`.
  [[nodiscard]] float mean_dielectric(float at_normal) const noexcept {
    const float edge = row_.in(detail::mean_edge_albedo<D>);
    return edge + at_normal * (1.0F - mean_missing() - edge);
  }

 private:
  [[nodiscard]] float interpolated(const detail::AlbedoGrid& grid, const detail::AlbedoPlace& place) const noexcept {
    const float below = place.in(grid[row_.index]);
    return below + row_.share * (place.in(grid[row_.index + 1]) - below);
  }

  detail::AlbedoPlace row_;
};

}  // namespace glint
