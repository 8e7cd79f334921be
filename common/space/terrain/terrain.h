// Terrain: ground and obstacles from a file. Each terrain entity has one read-only object. Engines, occlusion and
// renderers use it in the frame of the entity.
//
//   <terrain id="rocks"><position>0,0,0</position><orientation>0,0,0</orientation>
//     <octomap file="terrain/rocks.bt"/></terrain>
//   <terrain id="hills"><position>0,0,0</position><orientation>0,0,0</orientation>
//     <heightmap file="hills.png" size="20,20" height="0.3"/></terrain>
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "common/experiment/experiment.h"
#include "common/math/pose.h"

namespace swarmanoid
{

// It is parallel to the axes of the x, y plane of the terrain, and in metres.
struct TerrainRectangle
{
  Vector2 low;
  Vector2 high;
};

class Terrain
{
public:
  virtual ~Terrain() = default;

  // Returns the lower corner of the box around all solid parts, in metres.
  virtual Vector3 Low() const = 0;
  // Returns the upper corner of that box, in metres.
  virtual Vector3 High() const = 0;
  // Returns whether a point is inside something solid.
  virtual bool IsSolid(const Vector3& point) const = 0;
  // Returns the height (m) of the highest solid surface at or below a point, or nullopt if no surface is there.
  virtual std::optional<double> GroundBelow(const Vector3& point) const = 0;
  // Returns the fraction 0..1 of the way at which a segment enters something solid; 0 if it starts inside, nullopt if
  // it never does.
  virtual std::optional<double> SegmentHit(const Vector3& from, const Vector3& to) const = 0;
  // Returns the solid area at a height as few rectangles: the walls that a 2D engine at this height sees.
  virtual std::vector<TerrainRectangle> Section(double height) const = 0;
};

// VoxelTerrain: the occupied cubes of an OctoMap file (.bt or .ot), as a bitmap.
class VoxelTerrain : public Terrain
{
public:
  // Reads the file. Throws std::runtime_error, which names the file, if it cannot be read or has no occupied cube.
  explicit VoxelTerrain(const std::string& path);

  Vector3 Low() const override { return low_; }
  Vector3 High() const override { return low_ + cell_ * Vector3(nx_, ny_, nz_); }
  bool IsSolid(const Vector3& point) const override;
  std::optional<double> GroundBelow(const Vector3& point) const override;
  std::optional<double> SegmentHit(const Vector3& from, const Vector3& to) const override;
  std::vector<TerrainRectangle> Section(double height) const override;

  double CellSize() const { return cell_; }
  int CellsX() const { return nx_; }
  int CellsY() const { return ny_; }
  int CellsZ() const { return nz_; }
  // Returns false outside the map.
  bool IsOccupied(int x, int y, int z) const;

private:
  std::size_t Bit(int x, int y, int z) const
  {
    return (static_cast<std::size_t>(z) * static_cast<std::size_t>(ny_) + static_cast<std::size_t>(y)) *
               static_cast<std::size_t>(nx_) +
           static_cast<std::size_t>(x);
  }

  double cell_ = 0;
  Vector3 low_ = Vector3::Zero();
  int nx_ = 0, ny_ = 0, nz_ = 0;
  std::vector<bool> occupied_;
};

// HeightTerrain: a surface over a regular grid, with two triangles for each cell, solid below; from the greys of a PNG.
class HeightTerrain : public Terrain
{
public:
  // The picture spans size_x by size_y metres. Its upper left pixel is at x = 0 and the largest y. Black is 0, white is
  // `height` metres, and grey is in proportion (png_picture.h). Throws std::runtime_error, which names the file, if it
  // cannot be read or is smaller than 2 by 2 pixels.
  HeightTerrain(const std::string& path, double size_x, double size_y, double height);
  // Makes a terrain from columns * rows heights in metres, along x first, with the first row at y = 0.
  HeightTerrain(std::vector<double> heights, int columns, int rows, double size_x, double size_y);

  Vector3 Low() const override { return {0, 0, lowest_}; }
  Vector3 High() const override { return {size_x_, size_y_, highest_}; }
  bool IsSolid(const Vector3& point) const override;
  std::optional<double> GroundBelow(const Vector3& point) const override;
  std::optional<double> SegmentHit(const Vector3& from, const Vector3& to) const override;
  std::vector<TerrainRectangle> Section(double height) const override;

  int Columns() const { return columns_; }
  int Rows() const { return rows_; }
  // Returns the height of a grid point, in metres.
  double Height(int column, int row) const
  {
    return heights_[static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) +
                    static_cast<std::size_t>(column)];
  }
  std::span<const double> Heights() const { return heights_; }

private:
  std::optional<double> HeightAt(double x, double y) const;
  void FindExtremes();

  std::vector<double> heights_;
  int columns_, rows_;
  double size_x_, size_y_;
  double lowest_ = 0, highest_ = 0;
};

// Returns the terrain of an entity of kind kTerrain. Each file is read once in a process. Throws ConfigurationError.
std::shared_ptr<const Terrain> LoadTerrain(const EntityConfiguration& configuration,
                                           const std::string& experiment_folder);

}  // namespace swarmanoid
