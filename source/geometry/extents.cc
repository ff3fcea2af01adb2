#include <snug/geometry/extents.h>

#include <cmath>
#include <sstream>

namespace snug::geometry {
template <int dim>
std::string
extents(const dealii::Point<dim> &lower, const dealii::Point<dim> &upper, const double size)
{
  const double       least = 1e-9 * size;
  std::ostringstream text;
  for (unsigned int d = 0; d < dim; ++d)
    {
      const auto shown = [&](const double x) { return std::abs(x) < least ? 0. : x; };
      text << (d == 0 ? "" : ", ") << "xyz"[d] << ' ' << shown(lower[d]);
      if (upper[d] - lower[d] > least)
        text << " to " << shown(upper[d]);
    }
  return text.str();
}

template std::string extents(const dealii::Point<2> &, const dealii::Point<2> &, double);
template std::string extents(const dealii::Point<3> &, const dealii::Point<3> &, double);
} // namespace snug::geometry
