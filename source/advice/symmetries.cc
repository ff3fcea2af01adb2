#include <snug/advice/advice.h>
#include <snug/advice/point_data.h>
#include <snug/elasticity/element.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace snug::advice {
namespace {
/// { x : normal . x = offset }.
template <int dim>
struct Plane
{
  dealii::Tensor<1, dim> normal;
  double                 offset;

  Isometry<dim> mirror() const
  {
    return {dealii::Tensor<2, dim>(dealii::unit_symmetric_tensor<dim>()) -
              2. * outer_product(normal, normal),
            2. * offset * normal};
  }
};

template <int dim>
dealii::Tensor<1, dim> axis_vector(const unsigned int axis)
{
  dealii::Tensor<1, dim> e;
  e[axis] = 1.;
  return e;
}

/// Coordinates without rounding, which is small against @p size.
template <int dim>
std::string text_of(dealii::Tensor<1, dim> x, const double size)
{
  std::ostringstream text;
  for (unsigned int d = 0; d < dim; ++d)
    text << (d == 0 ? "(" : " ") << (std::abs(x[d]) < 1e-8 * size ? 0. : x[d]);
  return text.str() + ")";
}

template <int dim>
struct MassProperties
{
  dealii::Tensor<1, dim>          centre;
  dealii::SymmetricTensor<2, dim> second; ///< int x x' about the centre over the mass
};

/// Mean nodes and volumes of the cells of this rank.
template <int dim>
std::vector<std::pair<dealii::Point<dim>, double>> cell_masses(const mesh::BodyMesh<dim> &mesh)
{
  const elasticity::Element<dim>                     element(mesh.degree());
  std::vector<std::pair<dealii::Point<dim>, double>> result;
  for (const auto &cell : mesh.cells())
    {
      std::vector<dealii::Tensor<1, dim>> X;
      dealii::Tensor<1, dim>              mean;
      for (const unsigned int node : cell.nodes)
        {
          X.push_back(mesh.reference_positions()[node]);
          mean += X.back() / double(cell.nodes.size());
        }
      result.emplace_back(dealii::Point<dim>(mean), element.volume(X));
    }
  return result;
}

template <int dim>
class Symmetries
{
public:
  explicit Symmetries(const Subject<dim> &subject)
    : subject(subject), bodies(subject.mesh()), data(subject, bodies)
  {
    find_folds();
  }

  std::vector<Advice> planes() const
  {
    std::vector<Advice> advice;
    for (const auto &plane : candidates())
      {
        const auto mirror = plane.mirror();
        if (!keeps_responses(mirror) || !keeps_points(mirror, false) || !keeps_design(mirror))
          continue;
        std::ostringstream text;
        text << "all is the same on both sides of the plane through "
             << text_of<dim>(plane.offset * plane.normal, bodies.size()) << " with normal "
             << text_of(plane.normal, 1.)
             << ": model one half, held along the normal in that plane";
        advice.push_back({"symmetry plane", text.str(), 2., 0.});
      }
    return advice;
  }

  /// Turns by parts of the circle that no polygon has, and a mirror in a plane through the axis,
  /// which torsion does not keep.
  std::vector<Advice> revolution() const
  {
    const auto group = copies();
    if (dim == 2 || subject.shapes.n_variables() > 0 || group.size() > 48)
      return {};
    const auto                             mass = mass_properties(group);
    std::vector<std::pair<Vector, Vector>> lines; // point, axis
    for (unsigned int d = 0; d < dim; ++d)
      for (const Vector &centre : {mass.centre, Vector()})
        lines.push_back({centre, axis_vector<dim>(d)});
    for (const auto &axis : eigenvectors(mass.second))
      lines.push_back({mass.centre, axis.second});
    for (const auto &[centre, axis] : lines)
      {
        // a full turn's Q = a a' + cos (I - a a') + sin [a x]
        const auto aligned = dealii::Tensor<2, dim>(outer_product(axis, axis));
        const auto across  = dealii::Tensor<2, dim>(dealii::unit_symmetric_tensor<dim>()) - aligned;
        dealii::Tensor<2, dim> cross;
        for (unsigned int i = 0; i < dim; ++i)
          {
            const unsigned int j = (i + 1) % dim, k = (i + 2) % dim;
            cross[k][j] = axis[i];
            cross[j][k] = -axis[i];
          }
        const auto about = [&, point = centre](const dealii::Tensor<2, dim> &Q) {
          return Isometry<dim>{Q, point - Q * point};
        };
        const auto turn = [&](const double degrees) {
          const double angle = degrees * dealii::numbers::PI / 180.;
          return about(aligned + std::cos(angle) * across + std::sin(angle) * cross);
        };
        Vector side;
        for (unsigned int d = 0; d < dim; ++d)
          if (const Vector e = across * axis_vector<dim>(d); e.norm() > side.norm())
            side = e;
        side /= side.norm();
        const auto mirror = about(aligned + across - 2. * outer_product(side, side));
        if (!keeps_responses(turn(137.5)) || !keeps_points(turn(137.5), true) ||
            !keeps_points(turn(222.5), true) || !keeps_points(mirror, true))
          continue;
        std::ostringstream text;
        text << "all is the same around the axis through " << text_of(centre, bodies.size())
             << " along " << text_of(axis, 1.)
             << ": model the section, 'Dimension' = 2 and 'Model' = axisymmetric";
        const double solid = 3. * subject.mesh().n_global_free_nodes();
        return {{"body of revolution", text.str(),
                 solid / (2. * nodes_of_section(Point(centre), axis)), 0.}};
      }
    return {};
  }

private:
  using Point  = dealii::Point<dim>;
  using Vector = dealii::Tensor<1, dim>;

  /// Flat faces, held along their normal alone, with all bodies on one side.
  void find_folds()
  {
    for (const auto &at : data.surface())
      {
        const Plane<dim> plane{at.normal, at.normal * at.x};
        const auto       normal_only = dealii::Tensor<2, dim>(outer_product(at.normal, at.normal));
        if (lies_on_fold(at.x) || data.is_in_contact(at) || !data.is_free_of_loads(at) ||
            (data.held(at) - normal_only).norm() > 1e-6)
          continue;
        const double tolerance = 1e-6 * bodies.size();
        const bool   bounds =
          std::all_of(data.surface().begin(), data.surface().end(), [&](const Place<dim> &other) {
            const bool   same = other.body == at.body && other.boundary == at.boundary;
            const double off  = plane.normal * other.x - plane.offset;
            return off < tolerance && (!same || off > -tolerance);
          });
        if (bounds)
          folds.push_back(plane);
      }
  }

  bool lies_on_fold(const Point &x) const
  {
    return std::any_of(folds.begin(), folds.end(), [&](const Plane<dim> &fold) {
      return std::abs(fold.normal * x - fold.offset) < 1e-6 * bodies.size();
    });
  }

  /// The group that mirrors at the folds make; more than 48 are none that closes.
  std::vector<Isometry<dim>> copies() const
  {
    std::vector<Isometry<dim>> group = {
      {dealii::Tensor<2, dim>(dealii::unit_symmetric_tensor<dim>()), Vector()}};
    for (unsigned int i = 0; i < group.size() && group.size() <= 48; ++i)
      for (const auto &fold : folds)
        {
          const auto          mirror = fold.mirror();
          const Isometry<dim> next{mirror.Q * group[i].Q, mirror.Q * group[i].shift + mirror.shift};
          if (std::none_of(group.begin(), group.end(), [&](const Isometry<dim> &known) {
                return (known.Q - next.Q).norm() < 1e-6 &&
                       (known.shift - next.shift).norm() < 1e-6 * bodies.size();
              }))
            group.push_back(next);
        }
    return group;
  }

  /// Collective.
  MassProperties<dim> mass_properties(const std::vector<Isometry<dim>> &copies) const
  {
    std::vector<double> sums(1 + dim + dim * dim, 0.);
    for (const auto &[mean, mass] : cell_masses(subject.mesh()))
      for (const auto &copy : copies)
        {
          const Point x = copy(mean);
          sums[0] += mass;
          for (unsigned int i = 0; i < dim; ++i)
            {
              sums[1 + i] += mass * x[i];
              for (unsigned int j = 0; j < dim; ++j)
                sums[1 + dim + dim * i + j] += mass * x[i] * x[j];
            }
        }
    dealii::Utilities::MPI::sum(sums, subject.mesh().communicator(), sums);
    MassProperties<dim> result;
    for (unsigned int i = 0; i < dim; ++i)
      result.centre[i] = sums[1 + i] / sums[0];
    for (unsigned int i = 0; i < dim; ++i)
      for (unsigned int j = i; j < dim; ++j)
        result.second[i][j] =
          sums[1 + dim + dim * i + j] / sums[0] - result.centre[i] * result.centre[j];
    return result;
  }

  /// Return whether @p map keeps the data at the points of the whole scene. With @p fold, points
  /// outside the modelled part of the whole are mirrored back into this part.
  bool keeps_points(const Isometry<dim> &map, const bool fold) const
  {
    for (const auto *points : {&data.surface(), &data.inside()})
      for (const auto &from : *points)
        {
          if (fold && lies_on_fold(from.x) && from.normal.norm() > 0.)
            continue;
          auto  Q = map.Q;
          Point x = map(from.x);
          for (unsigned int turn = 0, i = 0; fold && turn < 64 && i < folds.size(); ++turn)
            if (folds[i].normal * x - folds[i].offset > 1e-9 * bodies.size())
              {
                Q = folds[i].mirror().Q * Q;
                x = folds[i].mirror()(x);
                i = 0;
              }
            else
              ++i;
          auto to = bodies.find(x, Q * from.normal);
          if (!to)
            return false;
          to->x = x; // free of the error of the search
          if (!data.agree(from, *to, Q))
            return false;
        }
    return true;
  }

  bool keeps_responses(const Isometry<dim> &map) const
  {
    const auto &asked = subject.scene.responses;
    return std::all_of(asked.begin(), asked.end(), [&](const auto &response) {
      const Point x = response.point.empty() ? Point() : contact::to_point<dim>(response.point);
      return response.point.empty() || map(x).distance(x) <= 1e-6 * bodies.size();
    });
  }

  /// Return whether each variable moves nodes and their mirror images symmetrically. Collective.
  bool keeps_design(const Isometry<dim> &map) const
  {
    const unsigned int n = subject.shapes.n_variables();
    if (n == 0)
      return true;
    const mesh::Surface<dim>  faces(subject.mesh(), subject.shapes.faces());
    const auto               &X = faces.reference_positions();
    std::vector<unsigned int> image;
    for (unsigned int a = 0; a < faces.n_nodes(); ++a)
      {
        const auto wanted = map(Point(X[a]));
        unsigned   b      = 0;
        while (b < faces.n_nodes() && wanted.distance(Point(X[b])) > 1e-6 * bodies.size())
          ++b;
        if (b == faces.n_nodes())
          return false;
        image.push_back(b);
      }
    for (unsigned int j = 0; j < n; ++j)
      {
        std::vector<double> design(n, 0.);
        design[j]          = 1.;
        const auto V       = faces.gather(subject.shapes.apply(design));
        double     largest = 0., off = 0.;
        for (unsigned int a = 0; a < image.size(); ++a)
          {
            largest = std::max(largest, V[a].norm());
            off     = std::max(off, (map.Q * V[a] - V[image[a]]).norm());
          }
        if (off > 1e-6 * largest)
          return false;
      }
    return !image.empty();
  }

  /// Normal to the coordinate and inertia axes, through the centroid, the middle of the box and
  /// the origin: of meshes that are not symmetric, the centroid is only nearly that of the bodies.
  /// And between the planes that a part of a whole has.
  std::vector<Plane<dim>> candidates() const
  {
    const auto  mass  = mass_properties({copies().front()});
    Vector      lower = data.surface().front().x, upper = lower;
    const auto &mesh = subject.mesh();
    for (unsigned int node = 0; node < mesh.n_local_nodes(); ++node)
      for (unsigned int d = 0; d < dim; ++d)
        {
          lower[d] = std::min(lower[d], mesh.reference_positions()[node][d]);
          upper[d] = std::max(upper[d], mesh.reference_positions()[node][d]);
        }
    std::vector<Plane<dim>> result;
    const auto              add = [&](const Vector &normal, const double offset) {
      for (const auto &known : result)
        if (std::abs(known.normal * normal) > 1. - 1e-12 &&
            std::abs(known.offset - offset * (known.normal * normal)) < 1e-8 * bodies.size())
          return;
      result.push_back({normal, offset});
    };
    for (unsigned int d = mesh.idealization().is_axisymmetric() ? 1 : 0; d < dim; ++d)
      {
        lower[d] = dealii::Utilities::MPI::min(lower[d], mesh.communicator());
        upper[d] = dealii::Utilities::MPI::max(upper[d], mesh.communicator());
        for (const double offset : {0.5 * (lower[d] + upper[d]), mass.centre[d], 0.})
          add(axis_vector<dim>(d), offset);
      }
    if (!mesh.idealization().is_axisymmetric())
      for (const auto &axis : eigenvectors(mass.second))
        add(axis.second, axis.second * mass.centre);
    for (const auto &a : folds)
      for (const auto &b : folds)
        if (const Vector between = a.normal - b.normal; between.norm() > 1e-3)
          add(between / between.norm(), (a.offset - b.offset) / between.norm());
    return result;
  }

  /// Return the number of nodes of the cells that a half-plane from the axis cuts, averaged over
  /// the angle. Collective.
  double nodes_of_section(const Point &on_axis, const Vector &axis) const
  {
    double around = 0.; // parts of the full turn
    for (const auto &copy : copies())
      around += copy.Q * axis * axis > 0.5;
    double cells = 0.;
    if constexpr (dim == 3)
      for (const auto &cell : subject.mesh().cells())
        {
          Vector              first;
          std::vector<double> angles; // of nodes off the axis, from the first of them
          for (const unsigned int node : cell.nodes)
            {
              Vector lever = subject.mesh().reference_positions()[node] - on_axis;
              lever -= (lever * axis) * axis;
              if (lever.norm() < 1e-8 * bodies.size())
                continue;
              if (angles.empty())
                first = lever;
              angles.push_back(
                std::atan2(dealii::cross_product_3d(first, lever) * axis, first * lever));
            }
          const auto ends = std::minmax_element(angles.begin(), angles.end());
          cells += (*ends.second - *ends.first) * around / (2. * dealii::numbers::PI);
        }
    return std::pow(subject.mesh().degree(), 2) *
           dealii::Utilities::MPI::sum(cells, subject.mesh().communicator());
  }

  const Subject<dim> &subject;
  TrueBodies<dim>     bodies;
  PointData<dim>      data;
  /// Planes on which a support makes the scene a part of a whole.
  std::vector<Plane<dim>> folds;
};
} // namespace

template <int dim>
std::vector<Advice> symmetries(const Subject<dim> &subject)
{
  const Symmetries<dim> found(subject);
  auto                  advice = found.revolution();
  // a section has all of its planes but those across the axis
  if (advice.empty())
    advice = found.planes();
  return advice;
}

template std::vector<Advice> symmetries(const Subject<2> &);
template std::vector<Advice> symmetries(const Subject<3> &);
} // namespace snug::advice
