#include <snug/geometry/entry_values.h>
#include <snug/mesh_file/surface_shapes.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <iomanip>

namespace snug::mesh_file {
namespace {
template <typename T>
void add_once(std::vector<T> &list, const T &value)
{
  if (std::find(list.begin(), list.end(), value) == list.end())
    list.push_back(value);
}

/// Return the minimum number of digits that represent @p value exactly.
int digits(const double value)
{
  char text[40];
  for (int n = 1; n < 17; ++n)
    {
      std::snprintf(text, sizeof text, "%.*e", n - 1, value);
      if (std::strtod(text, nullptr) == value)
        return n;
    }
  return 17;
}
} // namespace

template <int dim>
double last_digit(const std::vector<dealii::Point<dim>> &points)
{
  int    most    = 0;
  double largest = 0.;
  bool   single  = true;
  // A sample of about a thousand points suffices.
  for (std::size_t i = 0; i < points.size(); i += 1 + points.size() / 1000)
    for (unsigned int d = 0; d < dim; ++d)
      {
        const double x = points[i][d];
        most           = std::max(most, digits(x));
        largest        = std::max(largest, std::abs(x));
        single         = single && static_cast<double>(static_cast<float>(x)) == x;
      }
  if (most > 4 && most < 13)
    return std::pow(10., std::floor(std::log10(largest)) + 1 - most);
  return single && most > 4 ? 1.2e-7 * largest : 0.;
}

template <int dim>
SurfaceShapes<dim>::SurfaceShapes(BodySurface<dim>                   &the_surface,
                                  const geometry::BodyMeshParameters &parameters,
                                  const std::vector<std::string>     &boundary_names,
                                  std::vector<std::string>           &notes,
                                  const ExactFaces<dim>              *exact)
  : surface(the_surface)
  , parameters(parameters)
  , names(boundary_names)
  , notes(notes)
  , exact(exact)
  , digit(last_digit(surface.points))
{
  read_entries();
  for (const auto &part : surface.parts)
    shapes.push_back(shape_of(part));
  name_boundaries();
  move_nodes();
}

template <int dim>
void SurfaceShapes<dim>::read_entries()
{
  for (const auto &entry : parameters.surfaces)
    {
      const unsigned int boundary = geometry::index_of(names, entry.first);
      const std::string  given    = entry.first + ": " + entry.second;
      if (boundary == names.size())
        throw bad_entry("Surface", given,
                        "is not a boundary; the boundaries are " + to_text(names));
      if (entry.second != "facets" && entry.second != "smooth")
        throw bad_entry("Surface", given, "must be 'facets' or 'smooth'");
      wanted[boundary] = entry.second;
    }
}

template <int dim>
geometry::SurfaceSample<dim> SurfaceShapes<dim>::sample(const std::vector<unsigned int> &facets,
                                                        const bool middles) const
{
  geometry::SurfaceSample<dim> result;
  std::set<unsigned int>       nodes;
  const auto                   add_middle = [&](const Corners &of) {
    const auto found = surface.middles.find(of);
    if (middles && found != surface.middles.end())
      nodes.insert(found->second);
  };
  for (const unsigned int f : facets)
    {
      const Corners &corners = surface.facets[f].corners;
      nodes.insert(corners.begin(), corners.end());
      for (const Corners &edge : surface.edges(f))
        add_middle(edge);
      add_middle(geometry::sorted(corners));
      result.at.push_back(surface.centre(f));
      result.normals.push_back(surface.normal(f));
    }
  for (const unsigned int node : nodes)
    result.points.push_back(surface.points[node]);
  return result;
}

template <int dim>
typename SurfaceShapes<dim>::Shape
SurfaceShapes<dim>::shape_of(const std::vector<unsigned int> &part)
{
  if (surface.facets[part[0]].face != Facet::no_face)
    return exact_shape(part);
  Shape              result;
  const unsigned int boundary  = surface.facets[part[0]].boundary;
  const std::string  want      = wanted.count(boundary) > 0 ? wanted[boundary] : "";
  const bool         quadratic = want != "smooth" && surface.is_quadratic(part[0]);
  if (want == "facets")
    return result;
  const auto points = sample(part, quadratic);
  double     size   = 0.;
  for (const Point &point : points.points)
    size = std::max(size, point.distance(points.points[0]));
  const double tolerance = std::min(std::max(1e-6 * size, digit), 1e-4 * size);
  const double kink      = quadratic || want == "smooth" ? 0. : largest_kink(part);
  const auto  &name      = names[boundary];
  if (is_plane(points, tolerance, result.normal))
    result.kind = Kind::plane;
  else if ((result.known_index = recognized(points, tolerance, name, kink)) != none)
    result.kind = Kind::known;
  // A boundary of few facets may be smooth or a polyhedron.
  else if (kink > 15.)
    add_once(notes, "boundary " + name + " is kept faceted: neighbouring facets meet at up to " +
                      std::to_string(std::lround(kink)) + " degrees; 'Surface = " + name +
                      ": smooth' makes it smooth");
  else
    result.kind = quadratic ? Kind::quadratic : Kind::smooth;
  if (result.kind == Kind::quadratic)
    add_once(notes, "boundary " + name + " has the shape of its quadratic elements");
  if (result.kind == Kind::smooth)
    add_once(notes, "boundary " + name + " is a smooth surface through its nodes");
  return result;
}

template <int dim>
bool SurfaceShapes<dim>::is_plane(const geometry::SurfaceSample<dim> &points,
                                  const double                        tolerance,
                                  Vector                             &n) const
{
  n = Vector();
  for (const auto &normal : points.normals)
    n += normal / double(points.normals.size());
  // The normals around a hole, for example, have no common direction.
  if (n.norm() < 0.5)
    return false;
  n /= n.norm();
  // The normals of planes across an axis are exact, so that nodes keep their coordinate to the last
  // digit.
  for (unsigned int d = 0; d < dim; ++d)
    if (std::abs(n[d]) < 1e-10)
      n[d] = 0.;
  n /= n.norm();
  return std::all_of(points.points.begin(), points.points.end(), [&](const Point &point) {
    return std::abs((point - points.points[0]) * n) <= tolerance;
  });
}

template <int dim>
double SurfaceShapes<dim>::largest_kink(const std::vector<unsigned int> &part) const
{
  double largest = 0.;
  for (const unsigned int f : part)
    for (const Corners &ridge : surface.ridges_of(f))
      if (!surface.ridges.at(ridge).is_feature)
        largest = std::max(largest, surface.kink(ridge));
  return largest;
}

/// Return the maximum height of the true surface above the facets of a part. The arc through the
/// centres of two facets that meet at an angle t rises above each facet by t/8 of the distance of
/// the centres.
template <int dim>
double SurfaceShapes<dim>::facet_height(const std::vector<unsigned int> &part) const
{
  double largest = 0.;
  for (const unsigned int f : part)
    for (const Corners &ridge : surface.ridges_of(f))
      {
        const auto &at = surface.ridges.at(ridge);
        if (at.is_feature)
          continue;
        const unsigned int a = at.facets[0], b = at.facets[1];
        const double       turn =
          2. * std::asin(std::min(1., (surface.normal(a) - surface.normal(b)).norm() / 2.));
        largest = std::max(largest, turn / 8. * surface.centre(a).distance(surface.centre(b)));
      }
  return largest;
}

template <int dim>
void SurfaceShapes<dim>::name_boundaries()
{
  std::map<unsigned int, std::set<std::string>> found;
  for (unsigned int p = 0; p < shapes.size(); ++p)
    {
      const unsigned int boundary = surface.facets[surface.parts[p][0]].boundary;
      switch (shapes[p].kind)
        {
          case Kind::plane:
            found[boundary].insert("plane");
            break;
          case Kind::known:
            found[boundary].insert(surfaces[shapes[p].known_index].name());
            break;
          case Kind::quadratic:
            found[boundary].insert("quadratic elements");
            break;
          case Kind::smooth:
            found[boundary].insert("smooth");
            break;
          case Kind::exact:
            found[boundary].insert("CAD surface");
            break;
          case Kind::facets:
            found[boundary].insert("facets");
            double &height = boundary_shapes[boundary].facet_height;
            height         = std::max(height, facet_height(surface.parts[p]));
        }
    }
  for (const auto &[boundary, kinds] : found)
    {
      std::string &name = boundary_shapes[boundary].name;
      name.clear();
      for (const auto &kind : kinds)
        name += (name.empty() ? "" : " and ") + kind;
    }
}

/// Return the index of the known surface on which all points lie, or the number of surfaces.
template <int dim>
unsigned int SurfaceShapes<dim>::matching(const geometry::SurfaceSample<dim> &points,
                                          const double                        tolerance) const
{
  unsigned int index = 0;
  while (index < surfaces.size() &&
         !(points.largest_distance(surfaces[index]) <= tolerance &&
           points.oriented(surfaces[index]).encloses_body == surfaces[index].encloses_body))
    ++index;
  return index;
}

template <int dim>
typename SurfaceShapes<dim>::Shape
SurfaceShapes<dim>::exact_shape(const std::vector<unsigned int> &part)
{
  const Facet &facet = surface.facets[part[0]];
  const auto  &face  = exact->faces[facet.face];
  Shape        result;
  if (face.plane)
    {
      result.kind   = Kind::plane;
      result.normal = *face.plane * surface.normal(part[0]) > 0. ? *face.plane : -*face.plane;
      return result;
    }
  const auto points = sample(part, true);
  double     size   = 0.;
  for (const Point &point : points.points)
    size = std::max(size, point.distance(points.points[0]));
  const double rounding = 1e-12 * size;
  if (face.known)
    {
      result.known_index = matching(points, rounding);
      if (result.known_index == surfaces.size())
        surfaces.push_back(points.oriented(*face.known));
    }
  else
    result.known_index = recognized(points, 1e-6 * size, names[facet.boundary], 0.);
  result.kind       = result.known_index == none ? Kind::exact : Kind::known;
  result.projection = face.projection;
  return result;
}

template <int dim>
unsigned int SurfaceShapes<dim>::recognized(const geometry::SurfaceSample<dim> &points,
                                            const double                        tolerance,
                                            const std::string                  &name,
                                            const double                        kink)
{
  // Two parts of one cylinder use the same surface, and not two surfaces that differ by round-off.
  const unsigned int index = matching(points, tolerance);
  if (index == surfaces.size())
    {
      const auto found = geometry::recognized_surface(points, tolerance);
      if (!found)
        return none;
      surfaces.push_back(*found);
    }
  std::ostringstream text;
  text << "boundary " << name << " is a " << geometry::describe(surfaces[index])
       << " (maximum deviation " << std::setprecision(1) << points.largest_distance(surfaces[index])
       << ")";
  if (kink > 15.)
    text << ", although neighbouring facets meet at up to " << std::lround(kink)
         << " degrees; 'Surface = " << name << ": facets' keeps the facets";
  add_once(notes, text.str());
  return index;
}

template <int dim>
geometry::GeometryConstraints<dim>
SurfaceShapes<dim>::constraints(const std::vector<unsigned int> &facets) const
{
  std::set<unsigned int> indices; // ascending, so that all adjacent facets use the same order
  geometry::GeometryConstraints<dim> result;
  for (const unsigned int f : facets)
    {
      const Shape &shape = of_facet(f);
      if (shape.kind == Kind::known)
        indices.insert(shape.known_index);
      else if (shape.kind == Kind::plane)
        add_once(result.planes, shape.normal);
    }
  for (const unsigned int index : indices)
    result.surfaces.push_back(surfaces[index]);
  return result;
}

template <int dim>
std::shared_ptr<const geometry::Projection<dim>>
SurfaceShapes<dim>::projection(const std::vector<unsigned int> &facets, const Point &middle) const
{
  // Edges between planes are straight.
  if (exact == nullptr || std::all_of(facets.begin(), facets.end(), [&](const unsigned int f) {
        return of_facet(f).kind == Kind::plane;
      }))
    return {};
  const unsigned int first = surface.facets[facets[0]].face;
  const unsigned int last  = surface.facets[facets.back()].face;
  if (first != last)
    return exact->curve(first, last, middle);
  const Shape &shape = of_facet(facets[0]);
  return shape.kind == Kind::exact ? shape.projection : nullptr;
}

/// Move nodes onto known surfaces to the last digit, because otherwise the rounding of the file
/// changes normals.
template <int dim>
void SurfaceShapes<dim>::move_nodes()
{
  for (const auto &node : surface.facets_at)
    {
      const auto on = constraints(node.second);
      if (!on.surfaces.empty())
        surface.points[node.first] = on.onto(surface.points[node.first]);
    }
}

template class SurfaceShapes<2>;
template class SurfaceShapes<3>;
template double last_digit(const std::vector<dealii::Point<2>> &);
template double last_digit(const std::vector<dealii::Point<3>> &);
} // namespace snug::mesh_file
