#include <snug/state/support.h>

namespace snug
{
  namespace state
  {
    template <int dim>
    std::map<unsigned int, FixedFlags<dim>>
    fixed_components(const mesh::BodyMesh<dim>  &mesh,
                     const std::vector<Support> &supports)
    {
      std::map<unsigned int, FixedFlags<dim>> fixed;
      for (const auto &face : mesh.boundary_faces())
        {
          for (const Support &support : supports)
            if (support.body == face.body && support.boundary == face.boundary)
              for (const unsigned int node : face.nodes)
                for (const unsigned int c : support.components)
                  fixed[node][c] = true;
          if (mesh.idealization().is_axisymmetric())
            for (const unsigned int node : face.nodes)
              if (mesh.reference_positions()[node][0] == 0.)
                fixed[node][0] = true;
        }
      return fixed;
    }

    template <int dim>
    dealii::Tensor<1, dim>
    axis(unsigned int c)
    {
      dealii::Tensor<1, dim> e;
      e[c] = 1.;
      return e;
    }

    template <int dim>
    std::vector<dealii::Tensor<1, dim>>
    complement(const std::vector<dealii::Tensor<1, dim>> &fixed)
    {
      std::vector<dealii::Tensor<1, dim>> basis = fixed;
      while (basis.size() < dim)
        {
          dealii::Tensor<1, dim> best;
          for (unsigned int c = 0; c < dim; ++c)
            {
              dealii::Tensor<1, dim> candidate = axis<dim>(c);
              for (const auto &b : basis)
                candidate -= (candidate * b) * b;
              if (candidate.norm() > best.norm() + 1e-12)
                best = candidate;
            }
          basis.push_back(best / best.norm());
        }
      return {basis.begin() + fixed.size(), basis.end()};
    }

    template std::map<unsigned int, FixedFlags<2>>
    fixed_components<2>(const mesh::BodyMesh<2> &,
                        const std::vector<Support> &);
    template dealii::Tensor<1, 2>
    axis<2>(unsigned int);
    template std::vector<dealii::Tensor<1, 2>>
    complement(const std::vector<dealii::Tensor<1, 2>> &);
    template std::map<unsigned int, FixedFlags<3>>
    fixed_components<3>(const mesh::BodyMesh<3> &,
                        const std::vector<Support> &);
    template dealii::Tensor<1, 3>
    axis<3>(unsigned int);
    template std::vector<dealii::Tensor<1, 3>>
    complement(const std::vector<dealii::Tensor<1, 3>> &);
  } // namespace state
} // namespace snug
