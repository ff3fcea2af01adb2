#include <snug/shape/bezier_patch.h>
#include <snug/shape/shape_basis.h>

namespace snug
{
  namespace shape
  {
    namespace
    {
      /// The basis of scenes whose shape is fixed.
      template <int dim>
      class NoBasis : public ShapeBasis<dim>
      {
      public:
        using Field = typename ShapeBasis<dim>::Field;

        explicit NoBasis(const mesh::BodyMesh<dim> &mesh) : mesh(mesh)
        {
        }

        unsigned int
        n_variables() const override
        {
          return 0;
        }

        Field
        apply(const std::vector<double> &) const override
        {
          return Field(mesh.n_local_nodes());
        }

        std::vector<double>
        transpose(const Field &) const override
        {
          return {};
        }

        std::vector<Control<dim>>
        controls() const override
        {
          return {};
        }

        std::vector<std::pair<unsigned int, unsigned int>>
        faces() const override
        {
          return {};
        }

      private:
        const mesh::BodyMesh<dim> &mesh;
      };
    } // namespace

    template <int dim>
    typename ShapeBasis<dim>::Field
    ShapeBasis<dim>::column(unsigned int i) const
    {
      std::vector<double> alpha(n_variables(), 0.);
      alpha[i] = 1.;
      return apply(alpha);
    }

    template <int dim>
    const ChoiceTable<MakeShapeBasis<dim>> &
    shape_basis_table()
    {
      static const ChoiceTable<MakeShapeBasis<dim>> table = {
        {"none",
         "the shape is fixed",
         [](const auto &mesh, const auto &, const auto &) {
           return std::make_unique<NoBasis<dim>>(mesh);
         }},
        {"Bezier patch",
         "heights [length] of Bézier control points over a face of a body",
         [](const auto &mesh, const auto &bodies, const auto &parameters) {
           return std::make_unique<BezierPatch<dim>>(mesh, bodies, parameters);
         }}};
      return table;
    }

    template class ShapeBasis<2>;
    template class ShapeBasis<3>;
    template const ChoiceTable<MakeShapeBasis<2>> &
    shape_basis_table<2>();
    template const ChoiceTable<MakeShapeBasis<3>> &
    shape_basis_table<3>();
  } // namespace shape
} // namespace snug
