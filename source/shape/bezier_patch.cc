#include <snug/base/errors.h>
#include <snug/shape/bezier_patch.h>
#include <snug/shape/entries.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>

namespace snug
{
  namespace shape
  {
    namespace
    {
      /// The n Bernstein polynomials of degree n-1 at @p s, by the recurrence
      /// B_j^m = s B_(j-1)^(m-1) + (1-s) B_j^(m-1).
      std::vector<double>
      bernstein(unsigned int n, double s)
      {
        std::vector<double> values(n, 0.);
        values[0] = 1.;
        for (unsigned int m = 1; m < n; ++m)
          for (unsigned int j = m + 1; j-- > 0;)
            values[j] =
              (1. - s) * values[j] + (j == 0 ? 0. : s * values[j - 1]);
        return values;
      }
    } // namespace

    template <int dim>
    BezierPatch<dim>::BezierPatch(const mesh::BodyMesh<dim> &mesh,
                                  const BodyNames           &bodies,
                                  const ShapeParameters     &parameters)
      : mesh(mesh)
    {
      read_face(bodies, parameters.face);
      read_control_points(parameters.control_points);
      read_direction(parameters.direction);
      collect_weights();
    }

    template <int dim>
    void
    BezierPatch<dim>::read_face(const BodyNames   &bodies,
                                const std::string &face)
    {
      AssertDimension(bodies.names.size(), mesh.n_bodies());
      const auto        dot       = face.rfind('.');
      const std::string body_name = face.substr(0, dot);
      const auto        found =
        std::find(bodies.names.begin(), bodies.names.end(), body_name);
      if (dot == std::string::npos || found == bodies.names.end())
        throw bad_entry("Face",
                        face,
                        "must be body.face with one of the bodies " +
                          listed(bodies.names));
      body              = found - bodies.names.begin();
      const auto &names = mesh.geometry(body).boundary_names();
      const auto  name =
        std::find(names.begin(), names.end(), face.substr(dot + 1));
      if (name == names.end())
        throw bad_entry("Face",
                        face,
                        "the faces of " + body_name + " are " + listed(names));
      boundary = name - names.begin();
    }

    template <int dim>
    void
    BezierPatch<dim>::read_control_points(
      const std::vector<unsigned int> &numbers)
    {
      bool good = numbers.size() == dim - 1;
      for (const unsigned int number : numbers)
        good = good && number >= 2;
      if (!good)
        throw bad_entry("Control points",
                        listed(numbers),
                        dim == 2 ? "must be 1 number >= 2"
                                 : "must be 2 numbers >= 2");
      n = numbers;
    }

    template <int dim>
    void
    BezierPatch<dim>::read_direction(const std::vector<double> &components)
    {
      if (components.size() == dim)
        for (unsigned int d = 0; d < dim; ++d)
          direction[d] = components[d];
      const double length = direction.norm();
      if (!(length > 0.) || !std::isfinite(length))
        throw bad_entry("Direction",
                        listed(components),
                        "must be " + std::to_string(dim) +
                          " numbers, not all zero");
      direction /= length;
    }

    template <int dim>
    std::vector<double>
    BezierPatch<dim>::weights_at(const dealii::Point<dim> &fraction) const
    {
      const unsigned int normal = boundary / 2;
      const double       blend =
        boundary % 2 == 1 ? fraction[normal] : 1. - fraction[normal];
      std::vector<double> weights(1, blend);
      unsigned int        tangent = 0;
      for (unsigned int d = 0; d < dim; ++d)
        if (d != normal)
          {
            std::vector<double> product;
            for (const double polynomial : bernstein(n[tangent], fraction[d]))
              for (const double faster : weights)
                product.push_back(faster * polynomial);
            weights = product;
            ++tangent;
          }
      return weights;
    }

    template <int dim>
    void
    BezierPatch<dim>::collect_weights()
    {
      const auto &geometry = mesh.geometry(body);
      for (unsigned int node = 0; node < mesh.n_local_nodes(); ++node)
        {
          if (mesh.body_of_node(node) != body)
            continue;
          std::vector<std::pair<unsigned int, double>> from = {{node, 1.}};
          if (mesh.is_hanging(node))
            from = mesh.hanging()[mesh.hanging_index(node)].masters;
          std::vector<double> sum(n_variables(), 0.);
          for (const auto &source : from)
            {
              const auto weights = weights_at(
                geometry.box_fraction(mesh.logical_positions()[source.first]));
              for (unsigned int i = 0; i < n_variables(); ++i)
                sum[i] += source.second * weights[i];
            }
          NodeWeights entry{node, {}};
          for (unsigned int i = 0; i < n_variables(); ++i)
            if (sum[i] != 0.)
              entry.weights.emplace_back(i, sum[i]);
          if (!entry.weights.empty())
            node_weights.push_back(entry);
        }
    }

    template <int dim>
    unsigned int
    BezierPatch<dim>::n_variables() const
    {
      return dim == 2 ? n[0] : n[0] * n[dim - 2];
    }

    template <int dim>
    typename BezierPatch<dim>::Field
    BezierPatch<dim>::apply(const std::vector<double> &alpha) const
    {
      AssertDimension(alpha.size(), n_variables());
      Field result(mesh.n_local_nodes());
      for (const NodeWeights &entry : node_weights)
        {
          double height = 0.;
          for (const auto &weight : entry.weights)
            height += weight.second * alpha[weight.first];
          result[entry.node] = height * direction;
        }
      return result;
    }

    template <int dim>
    std::vector<double>
    BezierPatch<dim>::transpose(const Field &gradient) const
    {
      AssertDimension(gradient.size(), mesh.n_local_nodes());
      std::vector<double> local(n_variables(), 0.);
      for (const NodeWeights &entry : node_weights)
        {
          const double along = gradient[entry.node] * direction;
          for (const auto &weight : entry.weights)
            local[weight.first] += weight.second * along;
        }
      std::vector<double> result(n_variables());
      dealii::Utilities::MPI::sum(local, mesh.communicator(), result);
      return result;
    }

    template <int dim>
    std::vector<Control<dim>>
    BezierPatch<dim>::controls() const
    {
      std::vector<Control<dim>> result;
      const unsigned int        normal = boundary / 2;
      for (unsigned int i = 0; i < n_variables(); ++i)
        {
          dealii::Point<dim> fraction;
          fraction[normal]           = boundary % 2;
          unsigned int       tangent = 0;
          const unsigned int at[2]   = {i % n[0], i / n[0]};
          for (unsigned int d = 0; d < dim; ++d)
            if (d != normal)
              {
                fraction[d] = at[tangent] / (n[tangent] - 1.);
                ++tangent;
              }
          result.push_back(
            {i, mesh.geometry(body).box_position(fraction), direction});
        }
      return result;
    }

    template <int dim>
    std::vector<std::pair<unsigned int, unsigned int>>
    BezierPatch<dim>::faces() const
    {
      return {{body, boundary}};
    }

    template class BezierPatch<2>;
    template class BezierPatch<3>;
  } // namespace shape
} // namespace snug
