#include <snug/cad/size_field.h>

#include <BRepBndLib.hxx>
#include <BRepGProp.hxx>
#include <Bnd_Box.hxx>
#include <GProp_GProps.hxx>

#include <algorithm>
#include <array>
#include <cmath>
#include <sstream>

namespace snug::cad {
namespace {
using Point = dealii::Point<3>;

/// Return the distance of @p x from the closest or the farthest point of a box.
double distance(const Point &x, const Point &lower, const Point &upper, const bool closest)
{
  double square = 0.;
  for (unsigned int d = 0; d < 3; ++d)
    {
      const double below = lower[d] - x[d], above = x[d] - upper[d];
      const double along =
        closest ? std::max({0., below, above}) : std::max(std::abs(below), std::abs(above));
      square += along * along;
    }
  return std::sqrt(square);
}

/// Return the number of triangles or tetrahedra with edges of length 1 in a unit of area or volume.
double elements_per_volume(const unsigned int dim)
{
  return dim == 2 ? 4. / std::sqrt(3.) : 6. * std::sqrt(2.);
}
} // namespace

double ElementSizes::at(const Point &x) const
{
  double size = largest;
  for (const auto &source : sources)
    size = std::min(size, source.size + growth * source.at.distance(x));
  return size;
}

void ElementSizes::halve(const std::vector<Point> &places)
{
  if (places.empty())
    {
      largest *= 0.5;
      growth *= 0.5;
      for (auto &source : sources)
        source.size *= 0.5;
      return;
    }
  std::vector<SizeSource> halved;
  for (const auto &place : places)
    halved.push_back({place, 0.5 * at(place)});
  sources.insert(sources.end(), halved.begin(), halved.end());
}

SizeField::SizeField(const Part &part, ElementSizes the_sizes, const InputError &too_many)
  : sizes(std::move(the_sizes)), too_many(too_many), dim(part.dim)
{
  Bnd_Box box;
  BRepBndLib::Add(part.shape, box);
  // Gmsh may ask for sizes at points that are outside by rounding.
  box.Enlarge(0.01 * part.size);
  Point lower, upper;
  box.Get(lower[0], lower[1], lower[2], upper[0], upper[1], upper[2]);
  GProp_GProps properties;
  double       box_volume = 1.;
  for (unsigned int d = 0; d < dim; ++d)
    box_volume *= upper[d] - lower[d];
  if (dim == 2)
    BRepGProp::SurfaceProperties(part.shape, properties);
  else
    BRepGProp::VolumeProperties(part.shape, properties);
  part_of_box = std::abs(properties.Mass()) / box_volume;
  std::vector<unsigned int> all;
  for (unsigned int k = 0; k < sizes.sources.size(); ++k)
    all.push_back(k);
  view = "View \"element size\" {\n";
  add_box(lower, upper, all);
  view += "};\n";
}

void SizeField::add_box(const Point                     &lower,
                        const Point                     &upper,
                        const std::vector<unsigned int> &near)
{
  // Only these sources determine the size somewhere in the box.
  const auto size_at = [&](const unsigned int k, const bool closest) {
    const auto &source = sizes.sources[k];
    return source.size + sizes.growth * distance(source.at, lower, upper, closest);
  };
  double at_most = sizes.largest;
  for (const unsigned int k : near)
    at_most = std::min(at_most, size_at(k, false));
  double                    least = sizes.largest;
  std::vector<unsigned int> own;
  for (const unsigned int k : near)
    {
      const double size = size_at(k, true);
      if (size < at_most)
        own.push_back(k);
      least = std::min(least, size);
    }
  std::array<unsigned int, 3> parts;
  for (unsigned int d = 0; d < 3; ++d)
    parts[d] = !own.empty() && upper[d] - lower[d] > 2. * least ? 2 : 1;
  if (parts[0] * parts[1] * parts[2] == 1)
    return add_leaf(lower, upper, own);
  for (unsigned int i = 0; i < parts[0]; ++i)
    for (unsigned int j = 0; j < parts[1]; ++j)
      for (unsigned int k = 0; k < parts[2]; ++k)
        {
          const std::array<unsigned int, 3> place = {{i, j, k}};
          Point                             from, to;
          for (unsigned int d = 0; d < 3; ++d)
            {
              const double step = (upper[d] - lower[d]) / parts[d];
              from[d]           = lower[d] + place[d] * step;
              to[d]             = lower[d] + (place[d] + 1) * step;
            }
          add_box(from, to, own);
        }
}

void SizeField::add_leaf(const Point                     &lower,
                         const Point                     &upper,
                         const std::vector<unsigned int> &near)
{
  // The order of the corners of a hexahedron of Gmsh.
  const std::array<std::array<unsigned int, 3>, 8> order = {{{{0, 0, 0}},
                                                             {{1, 0, 0}},
                                                             {{1, 1, 0}},
                                                             {{0, 1, 0}},
                                                             {{0, 0, 1}},
                                                             {{1, 0, 1}},
                                                             {{1, 1, 1}},
                                                             {{0, 1, 1}}}};
  ElementSizes                                     own{{}, sizes.largest, sizes.growth};
  for (const unsigned int k : near)
    own.sources.push_back(sizes.sources[k]);
  std::ostringstream at, values;
  double             mean = 0., volume = 1.;
  at.precision(10);
  for (const auto &corner : order)
    {
      Point x;
      for (unsigned int d = 0; d < 3; ++d)
        x[d] = corner[d] == 0 ? lower[d] : upper[d];
      const double size = own.at(x);
      mean += size / 8.;
      const char *comma = &corner == &order[0] ? "" : ",";
      at << comma << x[0] << ',' << x[1] << ',' << x[2];
      values << comma << size;
    }
  for (unsigned int d = 0; d < dim; ++d)
    volume *= (upper[d] - lower[d]) / mean;
  n_elements += part_of_box * volume * elements_per_volume(dim);
  if (n_elements > 1e6)
    throw too_many;
  view += "SH(" + at.str() + "){" + values.str() + "};\n";
}
} // namespace snug::cad
