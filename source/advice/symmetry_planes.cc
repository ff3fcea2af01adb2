#include <snug/advice/conditions.h>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace snug::advice {
namespace {
/// This class checks whether a model is its own mirror image in planes through the mean of its
/// nodes. As the data are compared at points of the mesh, the mesh must be symmetric as well.
template <int dim>
class Mirrors
{
public:
  explicit Mirrors(const AdviceInput<dim> &input) : input(input), conditions(input)
  {
    for (const auto &at : conditions.on_faces())
      on_faces.push_back({at, conditions.data(at)});
    for (const auto &at : conditions.in_cells())
      in_cells.push_back({at, conditions.data(at)});
  }

  /// Return the advice for planes of symmetry at right angles to each other. Further planes would
  /// not halve the model again. Collective.
  std::vector<Advice> advice() const
  {
    std::vector<Advice> result;
    std::vector<Vector> found;
    for (const auto &normal : candidates())
      {
        if (std::any_of(found.begin(), found.end(),
                        [&](const Vector &other) { return std::abs(other * normal) > 1e-10; }))
          continue;
        const auto Q = dealii::Tensor<2, dim>(dealii::unit_symmetric_tensor<dim>()) -
                       2. * outer_product(normal, normal);
        if (!keeps_responses(Q) || !keeps(in_cells, Q) || !keeps(on_faces, Q) || !keeps_design(Q))
          continue;
        found.push_back(normal);
        std::ostringstream text;
        text << "the model is symmetric about the plane through "
             << text_of((conditions.centre() * normal) * normal) << " with normal "
             << text_of(normal) << ": model one half, held along the normal in that plane";
        result.push_back({"symmetry plane", text.str(), 2., 0.});
      }
    return result;
  }

private:
  using Point  = dealii::Point<dim>;
  using Vector = dealii::Tensor<1, dim>;
  using Places = std::vector<std::pair<Place<dim>, PointData<dim>>>;

  Point image(const dealii::Tensor<2, dim> &Q, const Point &x) const
  {
    return conditions.centre() + Q * (x - conditions.centre());
  }

  bool keeps(const Places &places, const dealii::Tensor<2, dim> &Q) const
  {
    Comparison<dim> comparison(conditions.size());
    for (const auto &[at, data] : places)
      comparison.add(at.weight, Q, data, image(Q, at.x), data, at.x);
    return comparison.is_equal(input.mesh().communicator());
  }

  bool keeps_responses(const dealii::Tensor<2, dim> &Q) const
  {
    const auto &responses = input.scene.responses;
    return std::all_of(responses.begin(), responses.end(), [&](const auto &response) {
      if (response.point.empty())
        return true;
      const auto x = contact::to_point<dim>(response.point);
      return image(Q, x).distance(x) < 1e-6 * conditions.size();
    });
  }

  /// Return whether each variable moves the nodes of shaped faces and their images alike.
  bool keeps_design(const dealii::Tensor<2, dim> &Q) const
  {
    const auto              &mesh = input.mesh();
    const mesh::Surface<dim> surface(mesh, input.shapes.faces());
    for (unsigned int j = 0; j < input.shapes.n_variables(); ++j)
      {
        std::vector<double> design(input.shapes.n_variables(), 0.);
        design[j]         = 1.;
        const auto      V = surface.gather(input.shapes.apply(design));
        Comparison<dim> comparison(conditions.size());
        // The surface is known to all ranks, and each rank adds all of it.
        for (unsigned int node = 0; node < surface.n_nodes(); ++node)
          {
            const Point          x(surface.reference_positions()[node]);
            const PointData<dim> motion = {vector_datum(V[node])};
            comparison.add(1., Q, motion, image(Q, x), motion, x);
          }
        if (!comparison.is_equal(mesh.communicator()))
          return false;
      }
    return true;
  }

  /// Return the axes and the directions in the middle between two of them.
  std::vector<Vector> candidates() const
  {
    if (input.mesh().idealization().is_axisymmetric())
      return {Vector(Point::unit_vector(1))};
    std::vector<Vector> normals;
    for (unsigned int d = 0; d < dim; ++d)
      normals.push_back(Point::unit_vector(d));
    for (unsigned int i = 0; i < dim; ++i)
      for (unsigned int j = 0; j < i; ++j)
        for (const double sign : {1., -1.})
          normals.push_back((normals[i] + sign * normals[j]) / std::sqrt(2.));
    return normals;
  }

  /// Return coordinates without round-off.
  std::string text_of(const Vector &x) const
  {
    std::ostringstream text;
    for (unsigned int d = 0; d < dim; ++d)
      text << (d == 0 ? "(" : " ") << (std::abs(x[d]) < 1e-8 * conditions.size() ? 0. : x[d]);
    return text.str() + ")";
  }

  const AdviceInput<dim> &input;
  const Conditions<dim>   conditions;
  Places                  on_faces, in_cells;
};
} // namespace

template <int dim>
std::vector<Advice> symmetry_planes(const AdviceInput<dim> &input)
{
  return Mirrors<dim>(input).advice();
}

template std::vector<Advice> symmetry_planes(const AdviceInput<2> &);
template std::vector<Advice> symmetry_planes(const AdviceInput<3> &);
} // namespace snug::advice
