"""soilbin's C++ floors; made by notebooks/stub.py. SI and radians throughout."""
from collections.abc import Callable, Sequence
from os import PathLike
from pathlib import Path
from typing import ClassVar, Optional, Union

from numpy import float64
from numpy.typing import NDArray

Array = NDArray[float64]
Told = Callable[[float, str], object]

__version__: str

class InputError(ValueError):
    """Input that is refused. The message reads 'file:line:column: message', then an excerpt and a hint where there are
    any.  file, line, column: where, None where the input is no file or the file is meant as a whole.
    """
    file: Optional[str]
    line: Optional[int]
    column: Optional[int]

class NoSolution(RuntimeError):
    """A question that the model has no answer to: the wheel would bury itself, or no sinkage carries the load. Never
    answered with a zero.
    """

class RunStopped(RuntimeError):
    """A run of grains that can't go on: an overlap too deep, a grain lost."""

class Estimate:
    """A number and its standard error (of an input: its standard deviation), in the same unit. std_error 0: taken as
    exact. A plain number does where one is asked for.
    """
    @property
    def value(self) -> float: ...
    @value.setter
    def value(self, value: float) -> None: ...
    @property
    def std_error(self) -> float:
        """at least 0"""
    @std_error.setter
    def std_error(self, value: float) -> None: ...
    def __init__(self, value: float, std_error: float = ...) -> None: ...
    def __float__(self) -> float: ...

class LugPattern:
    """How the lugs run across the tread."""
    straight: ClassVar[LugPattern]
    chevron: ClassVar[LugPattern]
    slanted: ClassVar[LugPattern]
    staggered: ClassVar[LugPattern]
    def __init__(self, value: int) -> None: ...
    def __int__(self) -> int: ...
    @property
    def name(self) -> str: ...
    @property
    def value(self) -> int: ...

class Lugs:
    """Lugs of a tire or grousers of a rover wheel."""
    @property
    def height(self) -> float:
        """from the tread base outward; 0 mm: smooth [m], at least 0 m"""
    @height.setter
    def height(self, value: float) -> None: ...
    @property
    def count(self) -> Optional[int]:
        """number around the circumference; staggered: on each side [-], at least 1"""
    @count.setter
    def count(self, value: Optional[int]) -> None: ...
    @property
    def thickness(self) -> Optional[float]:
        """along the circumference [m], above 0 m"""
    @thickness.setter
    def thickness(self, value: Optional[float]) -> None: ...
    @property
    def pattern(self) -> LugPattern:
        """how the lugs run across the tread"""
    @pattern.setter
    def pattern(self, value: LugPattern) -> None: ...
    @property
    def angle(self) -> Optional[float]:
        """between a bar and the axle; absent: 0.5 rad, and 0 of straight bars [rad], 0 rad .. 1.2 rad"""
    @angle.setter
    def angle(self, value: Optional[float]) -> None: ...
    def __init__(self, *, height: float, count: Optional[int] = ..., thickness: Optional[float] = ..., pattern: LugPattern = ..., angle: Optional[float] = ...) -> None:
        """By keywords: the attributes, in SI."""
    def replace(self, *, height: float = ..., count: Optional[int] = ..., thickness: Optional[float] = ..., pattern: LugPattern = ..., angle: Optional[float] = ...) -> Lugs:
        """A copy in which the attributes given are changed."""

class Tire:
    """A wheel as the soil meets it. Radius and width are those of the tread base, without lugs."""
    @property
    def name(self) -> str:
        """what to call the wheel"""
    @name.setter
    def name(self, value: str) -> None: ...
    @property
    def source(self) -> str:
        """where the wheel as a whole is described"""
    @source.setter
    def source(self, value: str) -> None: ...
    @property
    def radius(self) -> float:
        """radius to the tread base, without lugs [m], above 0 m"""
    @radius.setter
    def radius(self, value: float) -> None: ...
    @property
    def width(self) -> float:
        """width of the tread [m], above 0 m"""
    @width.setter
    def width(self, value: float) -> None: ...
    @property
    def lugs(self) -> Lugs:
        """lugs or grousers; absent: smooth"""
    @lugs.setter
    def lugs(self, value: Lugs) -> None: ...
    @property
    def inflation_pressure(self) -> Optional[float]:
        """read by the effect tire_flexibility alone; without it the wheel is rigid [Pa], at least 0 Pa"""
    @inflation_pressure.setter
    def inflation_pressure(self, value: Optional[float]) -> None: ...
    @property
    def carcass_pressure(self) -> Optional[Estimate]:
        """pressure that the carcass itself carries (Wong's p_c) [Pa], at least 0 Pa"""
    @carcass_pressure.setter
    def carcass_pressure(self, value: Optional[Estimate]) -> None: ...
    def __init__(self, *, name: str = ..., source: str = ..., radius: float, width: float, lugs: Lugs = ..., inflation_pressure: Optional[float] = ..., carcass_pressure: Optional[Union[Estimate, float]] = ...) -> None:
        """By keywords: the attributes, in SI."""
    def replace(self, *, name: str = ..., source: str = ..., radius: float = ..., width: float = ..., lugs: Lugs = ..., inflation_pressure: Optional[float] = ..., carcass_pressure: Optional[Union[Estimate, float]] = ...) -> Tire:
        """A copy in which the attributes given are changed."""

class SemiEmpiricalSoil:
    """Values of the Bekker / Wong-Reece model, each an Estimate. Pressure under a plate of smaller width b at depth z: p
    = (k_c/b + k_phi) z^n.
    """
    @property
    def exponent(self) -> Estimate:
        """n of p = (k_c/b + k_phi) z^n [-], 0.05 .. 5"""
    @exponent.setter
    def exponent(self, value: Estimate) -> None: ...
    @property
    def assumed_sd(self) -> Optional[float]:
        """share of a value below n that is its sd where it has none: an assumption; absent: exact [-], at least 0
        """
    @assumed_sd.setter
    def assumed_sd(self, value: Optional[float]) -> None: ...
    @property
    def k_c(self) -> Estimate:
        """cohesive modulus [N/m^(n+1)]"""
    @k_c.setter
    def k_c(self, value: Estimate) -> None: ...
    @property
    def k_phi(self) -> Estimate:
        """frictional modulus [N/m^(n+2)]"""
    @k_phi.setter
    def k_phi(self, value: Estimate) -> None: ...
    @property
    def cohesion(self) -> Estimate:
        """cohesion c of tau_max = c + p tan phi [Pa], at least 0 Pa"""
    @cohesion.setter
    def cohesion(self, value: Estimate) -> None: ...
    @property
    def friction_angle(self) -> Estimate:
        """angle of shearing resistance phi [rad], at least 0 rad and below 1.5708 rad"""
    @friction_angle.setter
    def friction_angle(self, value: Estimate) -> None: ...
    @property
    def shear_modulus(self) -> Estimate:
        """Janosi's shear deformation modulus K [m], above 0 m"""
    @shear_modulus.setter
    def shear_modulus(self, value: Estimate) -> None: ...
    @property
    def stress_angle_c1(self) -> Estimate:
        """c1 of theta_m = (c1 + c2 |s|) theta_1 [-], 0 .. 1"""
    @stress_angle_c1.setter
    def stress_angle_c1(self, value: Estimate) -> None: ...
    @property
    def stress_angle_c2(self) -> Estimate:
        """c2 of theta_m = (c1 + c2 |s|) theta_1 [-], -1 .. 2"""
    @stress_angle_c2.setter
    def stress_angle_c2(self, value: Estimate) -> None: ...
    @property
    def density(self) -> Optional[float]:
        """bulk density [kg/m^3], above 0 kg/m^3"""
    @density.setter
    def density(self, value: Optional[float]) -> None: ...
    @property
    def gravity(self) -> Optional[float]:
        """that pulls on soil and wheel; absent: Earth's [m/s^2], above 0 m/s^2"""
    @gravity.setter
    def gravity(self, value: Optional[float]) -> None: ...
    def __init__(self, *, exponent: Union[Estimate, float], assumed_sd: Optional[float] = ..., k_c: Union[Estimate, float], k_phi: Union[Estimate, float], cohesion: Union[Estimate, float], friction_angle: Union[Estimate, float], shear_modulus: Union[Estimate, float], stress_angle_c1: Union[Estimate, float] = ..., stress_angle_c2: Union[Estimate, float] = ..., density: Optional[float] = ..., gravity: Optional[float] = ...) -> None:
        """By keywords: the attributes, in SI."""
    def replace(self, *, exponent: Union[Estimate, float] = ..., assumed_sd: Optional[float] = ..., k_c: Union[Estimate, float] = ..., k_phi: Union[Estimate, float] = ..., cohesion: Union[Estimate, float] = ..., friction_angle: Union[Estimate, float] = ..., shear_modulus: Union[Estimate, float] = ..., stress_angle_c1: Union[Estimate, float] = ..., stress_angle_c2: Union[Estimate, float] = ..., density: Optional[float] = ..., gravity: Optional[float] = ...) -> SemiEmpiricalSoil:
        """A copy in which the attributes given are changed."""

class ContactPair:
    """Contact of two materials in the discrete element model."""
    @property
    def restitution(self) -> float:
        """speed after a collision over the speed before [-], 0 .. 1"""
    @restitution.setter
    def restitution(self, value: float) -> None: ...
    @property
    def sliding_friction(self) -> float:
        """coefficient of sliding friction [-], at least 0"""
    @sliding_friction.setter
    def sliding_friction(self, value: float) -> None: ...
    @property
    def rolling_friction(self) -> float:
        """coefficient of rolling friction [-], at least 0"""
    @rolling_friction.setter
    def rolling_friction(self, value: float) -> None: ...
    @property
    def rolling_damping(self) -> float:
        """dashpot of rolling, a share of critical; 0: grains rock on. Of elastic_plastic alone [-], 0 .. 1"""
    @rolling_damping.setter
    def rolling_damping(self, value: float) -> None: ...
    @property
    def cohesion(self) -> float:
        """energy density of linear cohesion: attraction over the contact's area; 0: none [J/m^3], at least 0 J/m^3
        """
    @cohesion.setter
    def cohesion(self, value: float) -> None: ...
    @property
    def rolling_stiffness(self) -> float:
        """couple a radian of rolling; of torsion_spring alone [N m], at least 0 N m"""
    @rolling_stiffness.setter
    def rolling_stiffness(self, value: float) -> None: ...
    def __init__(self, *, restitution: float, sliding_friction: float, rolling_friction: float, rolling_damping: float = ..., cohesion: float = ..., rolling_stiffness: float = ...) -> None:
        """By keywords: the attributes, in SI."""
    def replace(self, *, restitution: float = ..., sliding_friction: float = ..., rolling_friction: float = ..., rolling_damping: float = ..., cohesion: float = ..., rolling_stiffness: float = ...) -> ContactPair:
        """A copy in which the attributes given are changed."""

class RollingResistance:
    """How grains resist rolling (docs/theory/dem-laws.md)."""
    elastic_plastic: ClassVar[RollingResistance]
    directional: ClassVar[RollingResistance]
    directional_with_twist: ClassVar[RollingResistance]
    torsion_spring: ClassVar[RollingResistance]
    def __init__(self, value: int) -> None: ...
    def __int__(self) -> int: ...
    @property
    def name(self) -> str: ...
    @property
    def value(self) -> int: ...

class TwistingResistance:
    """How grains resist twisting (docs/theory/dem-laws.md)."""
    none: ClassVar[TwistingResistance]
    marshall: ClassVar[TwistingResistance]
    def __init__(self, value: int) -> None: ...
    def __int__(self) -> int: ...
    @property
    def name(self) -> str: ...
    @property
    def value(self) -> int: ...

class GrainShape:
    """What a grain is made of: a sphere, or several joined for good."""
    sphere: ClassVar[GrainShape]
    two_spheres: ClassVar[GrainShape]
    three_spheres: ClassVar[GrainShape]
    four_spheres: ClassVar[GrainShape]
    def __init__(self, value: int) -> None: ...
    def __int__(self) -> int: ...
    @property
    def name(self) -> str: ...
    @property
    def value(self) -> int: ...

class GranularSoil:
    """A soil as grains, radii uniform between two bounds."""
    @property
    def radius_min(self) -> float:
        """smallest grain radius [m], above 0 m"""
    @radius_min.setter
    def radius_min(self, value: float) -> None: ...
    @property
    def radius_max(self) -> float:
        """largest grain radius [m], above 0 m"""
    @radius_max.setter
    def radius_max(self, value: float) -> None: ...
    @property
    def grain_density(self) -> float:
        """density of a grain, not of the bed [kg/m^3], above 0 kg/m^3"""
    @grain_density.setter
    def grain_density(self, value: float) -> None: ...
    @property
    def gravity(self) -> Optional[float]:
        """that pulls on soil and wheel; absent: Earth's [m/s^2], above 0 m/s^2"""
    @gravity.setter
    def gravity(self, value: Optional[float]) -> None: ...
    @property
    def youngs_modulus(self) -> float:
        """E of a grain [Pa], above 0 Pa"""
    @youngs_modulus.setter
    def youngs_modulus(self, value: float) -> None: ...
    @property
    def poisson_ratio(self) -> float:
        """nu of a grain [-], above -1 and at most 0.5"""
    @poisson_ratio.setter
    def poisson_ratio(self, value: float) -> None: ...
    @property
    def rolling_resistance(self) -> RollingResistance:
        """how grains resist rolling; directional: the answer depends on the time step"""
    @rolling_resistance.setter
    def rolling_resistance(self, value: RollingResistance) -> None: ...
    @property
    def twisting_resistance(self) -> TwistingResistance:
        """how grains resist spin about the normal of their contact"""
    @twisting_resistance.setter
    def twisting_resistance(self, value: TwistingResistance) -> None: ...
    @property
    def shape(self) -> GrainShape:
        """what a grain is made of: a sphere, or several joined in a row, a triangle, a tetrahedron; radii are then those
        of the sphere of its volume
        """
    @shape.setter
    def shape(self, value: GrainShape) -> None: ...
    @property
    def sphere_spacing(self) -> float:
        """between the centres of a grain's spheres, in their radii; read where a grain has several [-], 0.1 .. 2
        """
    @sphere_spacing.setter
    def sphere_spacing(self, value: float) -> None: ...
    @property
    def grain_grain(self) -> ContactPair:
        """contact of two grains"""
    @grain_grain.setter
    def grain_grain(self, value: ContactPair) -> None: ...
    @property
    def grain_tire(self) -> ContactPair:
        """contact of a grain and the tire"""
    @grain_tire.setter
    def grain_tire(self, value: ContactPair) -> None: ...
    def __init__(self, *, radius_min: float, radius_max: float, grain_density: float, gravity: Optional[float] = ..., youngs_modulus: float, poisson_ratio: float, rolling_resistance: RollingResistance = ..., twisting_resistance: TwistingResistance = ..., shape: GrainShape = ..., sphere_spacing: float = ..., grain_grain: ContactPair, grain_tire: ContactPair) -> None:
        """By keywords: the attributes, in SI."""
    def replace(self, *, radius_min: float = ..., radius_max: float = ..., grain_density: float = ..., gravity: Optional[float] = ..., youngs_modulus: float = ..., poisson_ratio: float = ..., rolling_resistance: RollingResistance = ..., twisting_resistance: TwistingResistance = ..., shape: GrainShape = ..., sphere_spacing: float = ..., grain_grain: ContactPair = ..., grain_tire: ContactPair = ...) -> GranularSoil:
        """A copy in which the attributes given are changed."""

class Soil:
    """What the analytic model needs, what the grains need, or both."""
    @property
    def name(self) -> str:
        """what to call the soil"""
    @name.setter
    def name(self, value: str) -> None: ...
    @property
    def source(self) -> str:
        """where the soil as a whole is described"""
    @source.setter
    def source(self, value: str) -> None: ...
    @property
    def moisture(self) -> Optional[float]:
        """water content by mass [-], 0 .. 1"""
    @moisture.setter
    def moisture(self, value: Optional[float]) -> None: ...
    @property
    def semi_empirical(self) -> Optional[SemiEmpiricalSoil]:
        """values of the Bekker / Wong-Reece model"""
    @semi_empirical.setter
    def semi_empirical(self, value: Optional[SemiEmpiricalSoil]) -> None: ...
    @property
    def granular(self) -> Optional[GranularSoil]:
        """grains of the discrete element model"""
    @granular.setter
    def granular(self, value: Optional[GranularSoil]) -> None: ...
    def __init__(self, *, name: str = ..., source: str = ..., moisture: Optional[float] = ..., semi_empirical: Optional[SemiEmpiricalSoil] = ..., granular: Optional[GranularSoil] = ...) -> None:
        """By keywords: the attributes, in SI."""
    def replace(self, *, name: str = ..., source: str = ..., moisture: Optional[float] = ..., semi_empirical: Optional[SemiEmpiricalSoil] = ..., granular: Optional[GranularSoil] = ...) -> Soil:
        """A copy in which the attributes given are changed."""

class Bin:
    """Inner measures of the soil bin; only some effects ask for them."""
    @property
    def depth(self) -> float:
        """depth of the soil over the bin's floor [m], above 0 m"""
    @depth.setter
    def depth(self, value: float) -> None: ...
    @property
    def width(self) -> float:
        """inner width [m], above 0 m"""
    @width.setter
    def width(self, value: float) -> None: ...
    def __init__(self, *, depth: float, width: float) -> None:
        """By keywords: the attributes, in SI."""
    def replace(self, *, depth: float = ..., width: float = ...) -> Bin:
        """A copy in which the attributes given are changed."""

class SlipBy:
    """The speed from which slip is computed where the wheel is yawed."""
    wheel_plane_speed: ClassVar[SlipBy]
    travel_speed: ClassVar[SlipBy]
    def __init__(self, value: int) -> None: ...
    def __int__(self) -> int: ...
    @property
    def name(self) -> str: ...
    @property
    def value(self) -> int: ...

class ForceFrame:
    """Axes in which drawbar pull and lateral force are given."""
    travel: ClassVar[ForceFrame]
    wheel: ClassVar[ForceFrame]
    def __init__(self, value: int) -> None: ...
    def __int__(self) -> int: ...
    @property
    def name(self) -> str: ...
    @property
    def value(self) -> int: ...

class OperatingCondition:
    """What the wheel is asked to do. Signs: docs/reference/conventions.md."""
    @property
    def load(self) -> float:
        """vertical load on the axle, weight of the wheel included [N], above 0 N"""
    @load.setter
    def load(self, value: float) -> None: ...
    @property
    def slip(self) -> float:
        """positive drives [-], -1 .. 1"""
    @slip.setter
    def slip(self, value: float) -> None: ...
    @property
    def speed(self) -> float:
        """forward speed of the axle [m/s], at least 0 m/s"""
    @speed.setter
    def speed(self, value: float) -> None: ...
    @property
    def longitudinal_incline(self) -> float:
        """uphill positive [rad], above -1.5708 rad and below 1.5708 rad"""
    @longitudinal_incline.setter
    def longitudinal_incline(self, value: float) -> None: ...
    @property
    def transverse_incline(self) -> float:
        """cross slope, left side up positive [rad], above -1.5708 rad and below 1.5708 rad"""
    @transverse_incline.setter
    def transverse_incline(self, value: float) -> None: ...
    @property
    def yaw(self) -> float:
        """positive: the wheel points to the left of its travel [rad], -1.5708 rad .. 1.5708 rad"""
    @yaw.setter
    def yaw(self, value: float) -> None: ...
    @property
    def inflation_pressure(self) -> Optional[float]:
        """of the tire; absent: the tire's own [Pa], at least 0 Pa"""
    @inflation_pressure.setter
    def inflation_pressure(self, value: Optional[float]) -> None: ...
    @property
    def slip_by(self) -> SlipBy:
        """the speed from which slip is computed"""
    @slip_by.setter
    def slip_by(self, value: SlipBy) -> None: ...
    @property
    def force_frame(self) -> ForceFrame:
        """axes of drawbar pull and lateral force"""
    @force_frame.setter
    def force_frame(self, value: ForceFrame) -> None: ...
    @property
    def moisture(self) -> Optional[float]:
        """water content by mass [-], 0 .. 1"""
    @moisture.setter
    def moisture(self, value: Optional[float]) -> None: ...
    @property
    def position(self) -> Optional[float]:
        """mean distance along the bin [m]"""
    @position.setter
    def position(self, value: Optional[float]) -> None: ...
    @property
    def run(self) -> Optional[int]:
        """order in which the runs were made [-], at least 0"""
    @run.setter
    def run(self, value: Optional[int]) -> None: ...
    def __init__(self, *, load: float, slip: float, speed: float = ..., longitudinal_incline: float = ..., transverse_incline: float = ..., yaw: float = ..., inflation_pressure: Optional[float] = ..., slip_by: SlipBy = ..., force_frame: ForceFrame = ..., moisture: Optional[float] = ..., position: Optional[float] = ..., run: Optional[int] = ...) -> None:
        """By keywords: the attributes, in SI."""
    def replace(self, *, load: float = ..., slip: float = ..., speed: float = ..., longitudinal_incline: float = ..., transverse_incline: float = ..., yaw: float = ..., inflation_pressure: Optional[float] = ..., slip_by: SlipBy = ..., force_frame: ForceFrame = ..., moisture: Optional[float] = ..., position: Optional[float] = ..., run: Optional[int] = ...) -> OperatingCondition:
        """A copy in which the attributes given are changed."""

class EffectChoice:
    """An effect switched on: its id, its form, its parameters in SI."""
    @property
    def id(self) -> str: ...
    @property
    def form(self) -> str: ...
    @property
    def parameters(self) -> dict[str, float]:
        """by name, SI"""
    def __init__(self, id: str, form: str = ..., **parameters: float) -> None:
        """form '': the effect's first. Parameters by name, SI; those left out keep the form's defaults. Raises
        InputError with the nearest right word.
        """

class EffectParameter:
    """A parameter of an effect's form."""
    @property
    def name(self) -> str: ...
    @property
    def unit(self) -> str:
        """as in files; the numbers here are SI"""
    @property
    def default(self) -> float: ...
    @property
    def lower(self) -> float: ...
    @property
    def upper(self) -> float: ...
    @property
    def meaning(self) -> str: ...

class EffectForm:
    """One form of an effect: as published, after a source, or ours; its source says which."""
    @property
    def id(self) -> str: ...
    @property
    def form(self) -> str: ...
    @property
    def equation(self) -> str: ...
    @property
    def source(self) -> str:
        """paper and equation"""
    @property
    def parameters(self) -> list[EffectParameter]:
        """the first is the amplitude: at 0 the form is the base model"""

def effect_catalogue() -> list[EffectForm]:
    """Every form of every effect."""

class Controller:
    """What turns the wheel: a motor that holds a rim speed or one that gives a torque. Exactly one of the two is given.
    """
    @property
    def rim_speed(self) -> Optional[float]:
        """r w that the motor holds [m/s], above 0 m/s"""
    @rim_speed.setter
    def rim_speed(self, value: Optional[float]) -> None: ...
    @property
    def torque(self) -> Optional[float]:
        """that the motor gives [N m], above 0 N m"""
    @torque.setter
    def torque(self, value: Optional[float]) -> None: ...
    @property
    def highest_torque(self) -> Optional[float]:
        """of a motor that holds a rim speed [N m], above 0 N m"""
    @highest_torque.setter
    def highest_torque(self, value: Optional[float]) -> None: ...
    @property
    def highest_rim_speed(self) -> Optional[float]:
        """of a motor that gives a torque [m/s], above 0 m/s"""
    @highest_rim_speed.setter
    def highest_rim_speed(self, value: Optional[float]) -> None: ...
    @property
    def ramp(self) -> float:
        """over which the setpoint grows from rest [s], above 0 s"""
    @ramp.setter
    def ramp(self, value: float) -> None: ...
    @property
    def response(self) -> float:
        """time in which an error of speed is made good [s], above 0 s"""
    @response.setter
    def response(self, value: float) -> None: ...
    def __init__(self, *, rim_speed: Optional[float] = ..., torque: Optional[float] = ..., highest_torque: Optional[float] = ..., highest_rim_speed: Optional[float] = ..., ramp: float = ..., response: float = ...) -> None:
        """By keywords: the attributes, in SI."""
    def replace(self, *, rim_speed: Optional[float] = ..., torque: Optional[float] = ..., highest_torque: Optional[float] = ..., highest_rim_speed: Optional[float] = ..., ramp: float = ..., response: float = ...) -> Controller:
        """A copy in which the attributes given are changed."""

class Waypoint:
    """A place along the way. Angles and drawbar load go linearly from one to the next; a soil holds from its place on.
    """
    @property
    def at(self) -> float:
        """distance along the ground from the start [m], at least 0 m"""
    @at.setter
    def at(self, value: float) -> None: ...
    @property
    def longitudinal_incline(self) -> float:
        """slope along the way, uphill positive [rad], above -1.5708 rad and below 1.5708 rad"""
    @longitudinal_incline.setter
    def longitudinal_incline(self, value: float) -> None: ...
    @property
    def transverse_incline(self) -> float:
        """cross slope, left side up positive [rad], above -1.5708 rad and below 1.5708 rad"""
    @transverse_incline.setter
    def transverse_incline(self, value: float) -> None: ...
    @property
    def yaw(self) -> float:
        """positive: the wheel points to the left of its travel [rad], above -1.5708 rad and below 1.5708 rad"""
    @yaw.setter
    def yaw(self, value: float) -> None: ...
    @property
    def drawbar(self) -> float:
        """load pulled against travel [N], at least 0 N"""
    @drawbar.setter
    def drawbar(self, value: float) -> None: ...
    @property
    def soil(self) -> Optional[Soil]:
        """from here on: a mapping, a name of the library, or a path"""
    @soil.setter
    def soil(self, value: Optional[Soil]) -> None: ...
    def __init__(self, *, at: float, longitudinal_incline: float = ..., transverse_incline: float = ..., yaw: float = ..., drawbar: float = ..., soil: Optional[Soil] = ...) -> None:
        """By keywords: the attributes, in SI."""
    def replace(self, *, at: float = ..., longitudinal_incline: float = ..., transverse_incline: float = ..., yaw: float = ..., drawbar: float = ..., soil: Optional[Soil] = ...) -> Waypoint:
        """A copy in which the attributes given are changed."""

class Drive:
    """A wheel with mass and inertia, driven from rest (docs/theory/driven-wheel.md)."""
    @property
    def effects(self) -> list[EffectChoice]:
        """ids or EffectChoice; assign a new list to change them"""
    @effects.setter
    def effects(self, value: list[EffectChoice]) -> None: ...
    @property
    def load(self) -> float:
        """vertical load on the axle, weight of the wheel included [N], above 0 N"""
    @load.setter
    def load(self, value: float) -> None: ...
    @property
    def mass(self) -> Optional[float]:
        """that travels with the wheel; absent: load over the gravity on the case's soil [kg], above 0 kg"""
    @mass.setter
    def mass(self, value: Optional[float]) -> None: ...
    @property
    def inertia(self) -> Optional[float]:
        """of what spins, about the axle; absent: a tenth of mass times radius squared [kg m^2], above 0 kg m^2"""
    @inertia.setter
    def inertia(self, value: Optional[float]) -> None: ...
    @property
    def duration(self) -> float:
        """the drive ends then at the latest [s], above 0 s"""
    @duration.setter
    def duration(self, value: float) -> None: ...
    @property
    def distance(self) -> Optional[float]:
        """the drive has arrived there [m], above 0 m"""
    @distance.setter
    def distance(self, value: Optional[float]) -> None: ...
    @property
    def damping(self) -> float:
        """share of critical damping, of the soil under heave and of shear at rest [-], 0 .. 1"""
    @damping.setter
    def damping(self, value: float) -> None: ...
    @property
    def stuck_speed(self) -> float:
        """mean speed of travel below which the wheel is stuck [m/s], above 0 m/s"""
    @stuck_speed.setter
    def stuck_speed(self, value: float) -> None: ...
    @property
    def controller(self) -> Controller:
        """what turns the wheel"""
    @controller.setter
    def controller(self, value: Controller) -> None: ...
    @property
    def profile(self) -> dict[str, Array]:
        """places along the way; absent: level ground"""
    @profile.setter
    def profile(self, value: dict[str, Array]) -> None: ...
    def __init__(self, *, effects: Sequence[EffectChoice] = ..., load: float, mass: Optional[float] = ..., inertia: Optional[float] = ..., duration: float, distance: Optional[float] = ..., damping: float = ..., stuck_speed: float = ..., controller: Controller, profile: dict[str, Union[Array, Sequence[float]]] = ...) -> None:
        """By keywords: the attributes, in SI."""
    def replace(self, *, effects: Sequence[EffectChoice] = ..., load: float = ..., mass: Optional[float] = ..., inertia: Optional[float] = ..., duration: float = ..., distance: Optional[float] = ..., damping: float = ..., stuck_speed: float = ..., controller: Controller = ..., profile: dict[str, Union[Array, Sequence[float]]] = ...) -> Drive:
        """A copy in which the attributes given are changed."""

class Scenario:
    """Everything but the operating condition."""
    @property
    def tire(self) -> Tire: ...
    @tire.setter
    def tire(self, value: Tire) -> None: ...
    @property
    def soil(self) -> Soil: ...
    @soil.setter
    def soil(self, value: Soil) -> None: ...
    @property
    def bin(self) -> Optional[Bin]: ...
    @bin.setter
    def bin(self, value: Optional[Bin]) -> None: ...
    @property
    def effects(self) -> list[EffectChoice]:
        """ids or EffectChoice; assign a new list to change them"""
    @effects.setter
    def effects(self, value: list[EffectChoice]) -> None: ...
    def __init__(self, tire: Union[Tire, str], soil: Union[Soil, str], bin: Optional[Bin] = ..., effects: Sequence[Union[EffectChoice, str]] = ...) -> None:
        """Tire and soil: values, names of the library, or paths of YAML files. Effects: ids, 'id:form' or EffectChoice.
        Raises InputError with the nearest name.
        """
    def with_effects(self, effects: Sequence[Union[EffectChoice, str]]) -> Scenario:
        """A copy with these effects in place of its own."""

class ModelKind:
    """The models that a study can ask."""
    bekker_wong: ClassVar[ModelKind]
    dem: ClassVar[ModelKind]
    def __init__(self, value: int) -> None: ...
    def __int__(self) -> int: ...
    @property
    def name(self) -> str: ...
    @property
    def value(self) -> int: ...

class ModelChoice:
    """A model and the effects that it is to show."""
    @property
    def model(self) -> ModelKind: ...
    @property
    def effects(self) -> list[EffectChoice]: ...
    @property
    def label(self) -> str: ...

class Study:
    """What is asked of the models."""
    @property
    def name(self) -> str: ...
    @property
    def models(self) -> list[ModelChoice]: ...
    @property
    def conditions(self) -> list[OperatingCondition]:
        """assign a new list to change them"""
    @conditions.setter
    def conditions(self, value: list[OperatingCondition]) -> None: ...

class Case:
    """A whole question: a study, a drive or both."""
    @property
    def name(self) -> str: ...
    @property
    def description(self) -> str: ...
    @property
    def source(self) -> str: ...
    @property
    def scenario(self) -> Scenario:
        """without effects: these belong to the study's models and the drive"""
    @property
    def study(self) -> Study:
        """without conditions where the file has none"""
    @property
    def drive(self) -> Optional[Drive]: ...
    @drive.setter
    def drive(self, value: Optional[Drive]) -> None: ...
    def yaml(self) -> str:
        """The resolved case as YAML."""

def cases_folders() -> list[Path]:
    """Folders that are searched for cases: $SOILBIN_CASES first."""

class Shelf:
    """The folders of a library of cases."""
    tires: ClassVar[Shelf]
    soils: ClassVar[Shelf]
    studies: ClassVar[Shelf]
    measured: ClassVar[Shelf]
    def __init__(self, value: int) -> None: ...
    def __int__(self) -> int: ...
    @property
    def name(self) -> str: ...
    @property
    def value(self) -> int: ...

def names(shelf: Shelf) -> list[str]:
    """Every name on a shelf of the library, sorted."""

def find_tire(name: str) -> Tire:
    """A tire of the library, or of a YAML file (a path holds '/' or ends in .yaml). Raises InputError with file, line
    and the nearest name.
    """

def find_soil(name: str) -> Soil:
    """A soil of the library, or of a YAML file. Raises InputError."""

def find_case(name: str) -> Case:
    """A study of the library, or of a YAML file. Raises InputError."""

def parse_case(text: str, file: str = ...) -> Case:
    """A case from its YAML; `file` is what errors name and where relative paths start. Raises InputError."""

def write_tire(tire: Tire) -> str:
    """The tire as a YAML file's text."""

def write_soil(soil: Soil) -> str:
    """The soil as a YAML file's text."""

class TractionResult:
    """The answer of a model or of a measurement at one condition; the four channels are Estimates, value and std_error.
    """
    @property
    def at(self) -> OperatingCondition: ...
    @property
    def drawbar_pull(self) -> Estimate:
        """F_DP [N] along travel, less the slope's share of the load"""
    @property
    def torque(self) -> Estimate:
        """M [N m]; positive drives"""
    @property
    def sinkage(self) -> Estimate:
        """z [m]"""
    @property
    def lateral_force(self) -> Estimate:
        """F_y [N], to the left of travel"""
    @property
    def tractive_efficiency(self) -> float:
        """power at the drawbar over power put in [-]; NaN unless the wheel is driven and pulls along its travel"""
    @property
    def entry_angle(self) -> float:
        """theta_1 [rad]"""
    @property
    def max_stress_angle(self) -> float:
        """theta_m [rad]"""
    @property
    def exit_angle(self) -> float:
        """theta_2 [rad]; negative behind the axle"""
    @property
    def budget(self) -> dict[str, float]:
        """named parts [N] that add up to the drawbar pull, but for budget_rest"""
    @property
    def budget_rest(self) -> dict[str, float]:
        """force [N]: the drawbar pull less the sum of its parts; bound [N]: the largest that is no sign of a fault, NaN
        where it isn't known
        """
    @property
    def patch(self) -> dict[str, Array]:
        """stresses under the wheel, from exit to entry: arrays of one shape (nodes,): theta [rad], normal, shear,
        lateral_shear [Pa]; views of the result, not copies
        """
    @property
    def without_error_of(self) -> list[str]:
        """parameters of the soil that the standard errors leave out: the results have no derivative by them"""

def channels() -> list[str]:
    """Names of the four channels, in the order of every table."""

class Answer:
    """What a model says at one condition: a result, or why there is none."""
    @property
    def at(self) -> OperatingCondition: ...
    @property
    def result(self) -> Optional[TractionResult]:
        """None where there is none"""
    @property
    def error(self) -> str:
        """'' where there is a result"""

def answer_of(result: TractionResult) -> Answer:
    """The result as an Answer."""

class Model:
    """One way of answering."""
    @property
    def name(self) -> str: ...
    def evaluate(self, scenario: Scenario, at: OperatingCondition) -> TractionResult:
        """The answer at one condition, a TractionResult [SI]. Raises InputError where the scenario lacks what the model
        needs, NoSolution where it has no answer.
        """

class BekkerWong(Model):
    """The Bekker / Wong-Reece model (docs/reference/conventions.md)."""
    def __init__(self, errors: bool = ..., patch: bool = ...) -> None:
        """errors: standard errors from the soil's standard deviations, to first order. patch: stresses under the wheel.
        Without them it is several times as fast.
        """

def answers(model: Model, scenario: Scenario, conditions: Sequence[OperatingCondition], progress: Optional[Told] = ...) -> list[Answer]:
    """A list of Answers, one for each condition, in their order; one without solution carries its error. progress:
    called with (share done 0 .. 1, stage).
    """

class Step:
    """One equation, in symbols and in numbers."""
    @property
    def name(self) -> str: ...
    @property
    def equation(self) -> str: ...
    @property
    def numbers(self) -> str: ...
    @property
    def value(self) -> float:
        """in `unit`"""
    @property
    def unit(self) -> str: ...
    @property
    def remark(self) -> str: ...

class Explanation:
    """Why the semi-empirical answer is what it is."""
    @property
    def result(self) -> TractionResult: ...
    @property
    def steps(self) -> list[Step]:
        """of the model, in the order in which it takes them"""
    @property
    def effects(self) -> list[Step]: ...
    @property
    def cross_checks(self) -> list[Step]:
        """closed forms that need no balance"""

def explain(scenario: Scenario, at: OperatingCondition) -> Explanation:
    """The model's equations with their values. Raises InputError and NoSolution as the model does."""

def doubts(case: Case) -> list[str]:
    """What is possible in a case, but hardly meant: sentences."""

def doubts_of(scenario: Scenario, answers: Sequence[Answer]) -> list[str]:
    """What the command would warn of beside these answers of the analytic model: sentences."""

def in_words(at: OperatingCondition) -> str:
    """A condition in words, without what is at its default."""

class Presumed:
    """A value that an effect takes although the wheel does not declare it."""
    @property
    def key(self) -> str:
        """as in a tire file: 'lugs.height'"""
    @property
    def value(self) -> float:
        """[SI]"""
    @property
    def words(self) -> str:
        """'lug height = 12.5 mm (5 % of the radius)'"""

def presumed(effect: Union[EffectChoice, str], tire: Tire) -> list[Presumed]:
    """What an effect takes for values that the tire does not declare; empty where the tire declares all that it reads.
    effect: 'lug_thrust', 'lug_thrust:FORM' or an EffectChoice.
    """

class RolledWheel:
    """A wheel at one sinkage: contact and forces, in the wheel's axes."""
    @property
    def at(self) -> OperatingCondition: ...
    @property
    def sinkage(self) -> float:
        """z [m]"""
    @property
    def entry_angle(self) -> float:
        """theta_1 [rad]"""
    @property
    def max_stress_angle(self) -> float:
        """theta_m [rad]"""
    @property
    def exit_angle(self) -> float:
        """theta_2 [rad]"""
    @property
    def nodes(self) -> dict[str, Array]:
        """arrays of one shape (nodes,), the nodes of the quadrature, views: theta [rad], arc (weight times arc length)
        [m], depth [m], sigma, strength, tau_x, tau_y [Pa], j_x, j_y [m]
        """
    @property
    def thrust(self) -> float:
        """[N]"""
    @property
    def compaction(self) -> float:
        """compaction resistance, negative [N]"""
    @property
    def vertical(self) -> float:
        """load that the contact carries [N]"""
    @property
    def torque(self) -> float:
        """[N m]"""

class RollingWheel:
    """The wheel of Wong and Reece (1967) on its soil, with effects."""
    def __init__(self, scenario: Scenario) -> None:
        """Raises InputError where a value is missing or out of range."""
    def roll(self, at: OperatingCondition) -> RolledWheel:
        """The balanced wheel. Raises InputError, NoSolution."""
    def at_entry_angle(self, at: OperatingCondition, theta_1: float) -> RolledWheel:
        """The wheel at a given theta_1 [rad], balanced or not: `vertical` says what it carries."""

class PullPeak:
    """The largest drawbar pull [N] and the slip that gives it."""
    @property
    def slip(self) -> float:
        """[-]"""
    @property
    def drawbar_pull(self) -> float:
        """[N]"""

def largest_pull(scenario: Scenario, at: OperatingCondition) -> PullPeak:
    """Largest drawbar pull over 0 <= slip <= 1; the slip of `at` is not read. Raises NoSolution where no slip has a
    balance.
    """

def slip_for_pull(scenario: Scenario, at: OperatingCondition, drawbar: float = ...) -> Optional[float]:
    """Smallest slip above -0.5 at which the wheel pulls `drawbar` [N] on the slope of `at`; None where it can't.
    """

def steepest_slope(scenario: Scenario, at: OperatingCondition, drawbar: float = ...) -> Optional[Estimate]:
    """Steepest slope [rad] that the wheel climbs while it pulls `drawbar` [N], an Estimate; None beyond -60 .. 80 deg.
    """

def bekker_static_sinkage(scenario: Scenario, load: float) -> float:
    """Bekker's static sinkage of a towed rigid wheel [m] (Bekker 1956). load [N] >= 0."""

def rolling_resistance(scenario: Scenario, load: float) -> float:
    """Bekker's rolling resistance of a towed rigid wheel [N] (Bekker 1956). load [N] >= 0."""

def critical_ground_pressure(scenario: Scenario, load: float) -> float:
    """Wong's critical ground pressure [Pa]: a tire harder than this rolls as if rigid. load [N] >= 0."""

class EnergyLedger:
    """Where the motor's work went, from the start [J]."""
    @property
    def motor(self) -> float:
        """Int M w dt"""
    @property
    def kinetic(self) -> float: ...
    @property
    def height(self) -> float:
        """gained against the load"""
    @property
    def drawbar(self) -> float: ...
    @property
    def compaction(self) -> float:
        """pressing the soil"""
    @property
    def shear(self) -> float:
        """shearing it"""
    @property
    def added(self) -> float:
        """against the effects' added forces"""
    @property
    def damping(self) -> float: ...
    @property
    def unaccounted(self) -> float:
        """the integration's error"""

class DriveHappening:
    """What happened on the way: time [s], travelled [m], what."""
    @property
    def time(self) -> float: ...
    @property
    def travelled(self) -> float: ...
    @property
    def what(self) -> str: ...

class DriveEnd:
    """Why a drive ended."""
    time_is_up: ClassVar[DriveEnd]
    arrived: ClassVar[DriveEnd]
    stuck: ClassVar[DriveEnd]
    buried: ClassVar[DriveEnd]
    rolled_back: ClassVar[DriveEnd]
    bed_ends: ClassVar[DriveEnd]
    def __init__(self, value: int) -> None: ...
    def __int__(self) -> int: ...
    @property
    def name(self) -> str: ...
    @property
    def value(self) -> int: ...

class DriveRecord:
    """What came of a drive."""
    @property
    def end(self) -> DriveEnd:
        """why it ended"""
    @property
    def end_time(self) -> float:
        """[s]"""
    @property
    def happenings(self) -> list[DriveHappening]: ...
    @property
    def energy(self) -> EnergyLedger:
        """at the end"""
    @property
    def samples(self) -> dict[str, Array]:
        """arrays of one shape (samples,), SI and radians, views but for slip (NaN while the wheel all but stands); works
        in J since the start
        """

def drive_wheel(scenario: Scenario, drive: Drive, samples: int = ..., progress: Optional[Told] = ...) -> DriveRecord:
    """Drives the wheel from rest; effects are those of the drive. samples: intervals of time over the whole duration.
    progress: called with (share done, stage). Raises InputError for an effect that a drive can't take, NoSolution
    where the soil can't hold the wheel at its start.
    """

class PlateTest:
    """One plate pressed in once: pressure [Pa] strictly increasing, sinkage [m]."""
    @property
    def radius(self) -> float:
        """b [m]; of a strip its width"""
    @property
    def pressure(self) -> Array:
        """[Pa], shape (readings,)"""
    @property
    def sinkage(self) -> Array:
        """[m], shape (readings,)"""
    def __init__(self, radius: float, pressure: Union[Array, Sequence[float]], sinkage: Union[Array, Sequence[float]]) -> None:
        """radius [m]; pressure [Pa] and sinkage [m]: arrays of one shape (readings,)."""

class PlateCurve:
    """Sinkage [m] against pressure [Pa] of one plate; no zeros."""
    @property
    def radius(self) -> float:
        """b [m]; of a strip its width"""
    @property
    def pressure(self) -> Array:
        """[Pa], shape (readings,)"""
    @property
    def sinkage(self) -> Array:
        """[m], shape (readings,)"""
    def __init__(self, radius: float, pressure: Union[Array, Sequence[float]], sinkage: Union[Array, Sequence[float]]) -> None:
        """radius [m]; pressure [Pa] and sinkage [m]: arrays of one shape (readings,)."""

class PlateExponent:
    """How one exponent comes from several plates."""
    mean_of_plates: ClassVar[PlateExponent]
    common: ClassVar[PlateExponent]
    def __init__(self, value: int) -> None: ...
    def __int__(self) -> int: ...
    @property
    def name(self) -> str: ...
    @property
    def value(self) -> int: ...

class PlateFit:
    """n, k_c and k_phi of Bekker's p = (k_c/b + k_phi) z^n."""
    @property
    def exponent(self) -> float:
        """n [-]"""
    @property
    def k_c(self) -> float:
        """[N/m^(n+1)]"""
    @property
    def k_phi(self) -> float:
        """[N/m^(n+2)]; may come out negative where the plates disagree with Bekker's form"""
    @property
    def plate_exponents(self) -> list[float]:
        """n of each plate by itself [-]"""
    @property
    def plate_moduli(self) -> list[float]:
        """k of each plate at the exponent [N/m^(n+2)]"""

def mean_curve(repeats: Sequence[PlateTest], first: float, step: float, last: float) -> PlateCurve:
    """Mean of repeats with one plate: sinkages by a cubic spline over pressure, at first, first + step, .., last [Pa].
    Raises InputError for plates of different radii.
    """

def fit_plates(curves: Sequence[PlateCurve], exponent: PlateExponent = ...) -> PlateFit:
    """Least squares in logarithms with weights p^2 (Wong 1980), then k_c and k_phi by a line through the moduli over
    1/b. Raises InputError for fewer than two radii.
    """

def fit_plates_at(curves: Sequence[PlateCurve], exponent: float) -> PlateFit:
    """The same at a given exponent."""

class JanosiFit:
    """tau = tau_max (1 - exp(-j/K)) (Janosi and Hanamoto 1961)."""
    @property
    def shear_max(self) -> float:
        """tau_max [Pa]"""
    @property
    def modulus(self) -> float:
        """K [m]"""
    @property
    def rms(self) -> float:
        """of what is left [Pa]"""

def fit_janosi(displacement: Union[Array, Sequence[float]], shear_stress: Union[Array, Sequence[float]]) -> JanosiFit:
    """Least squares in tau; displacements j > 0 [m] and stresses [Pa], arrays of one shape (readings,). Raises
    InputError for fewer than four points.
    """

class NormalLaw:
    """Which law acts at the contacts (docs/theory/dem-laws.md)."""
    hertz: ClassVar[NormalLaw]
    hooke: ClassVar[NormalLaw]
    def __init__(self, value: int) -> None: ...
    def __int__(self) -> int: ...
    @property
    def name(self) -> str: ...
    @property
    def value(self) -> int: ...

class RollingLaw:
    """Which law acts at the contacts (docs/theory/dem-laws.md)."""
    none: ClassVar[RollingLaw]
    elastic_plastic: ClassVar[RollingLaw]
    directional: ClassVar[RollingLaw]
    directional_with_twist: ClassVar[RollingLaw]
    spring_slider: ClassVar[RollingLaw]
    torsion_spring: ClassVar[RollingLaw]
    def __init__(self, value: int) -> None: ...
    def __int__(self) -> int: ...
    @property
    def name(self) -> str: ...
    @property
    def value(self) -> int: ...

class CohesionLaw:
    """Which law acts at the contacts (docs/theory/dem-laws.md)."""
    none: ClassVar[CohesionLaw]
    linear: ClassVar[CohesionLaw]
    jkr: ClassVar[CohesionLaw]
    def __init__(self, value: int) -> None: ...
    def __int__(self) -> int: ...
    @property
    def name(self) -> str: ...
    @property
    def value(self) -> int: ...

class Material:
    """What grains are made of."""
    @property
    def density(self) -> float:
        """[kg/m^3], above 0"""
    @property
    def young(self) -> float:
        """Young's modulus [Pa], above 0"""
    @property
    def poisson(self) -> float:
        """Poisson's ratio [-], in (-1, 0.5]"""
    def __init__(self, density: float = ..., young: float = ..., poisson: float = ...) -> None: ...

class Interaction:
    """What two materials do at a contact beyond their elastic constants."""
    @property
    def restitution(self) -> float:
        """e [-], 0 .. 1"""
    @restitution.setter
    def restitution(self, value: float) -> None: ...
    @property
    def sliding_friction(self) -> float:
        """mu [-], at least 0"""
    @sliding_friction.setter
    def sliding_friction(self, value: float) -> None: ...
    @property
    def rolling_friction(self) -> float:
        """mu_r [-], at least 0"""
    @rolling_friction.setter
    def rolling_friction(self, value: float) -> None: ...
    @property
    def rolling_damping(self) -> float:
        """of elastic_plastic, share of critical; 0 until set, where a soil's grains have 0.3"""
    @rolling_damping.setter
    def rolling_damping(self, value: float) -> None: ...
    @property
    def rolling_stiffness(self) -> float:
        """spring_slider [N/m], torsion_spring [N m/rad]"""
    @rolling_stiffness.setter
    def rolling_stiffness(self, value: float) -> None: ...
    @property
    def cohesion(self) -> float:
        """linear: [J/m^3]; jkr: work of adhesion [J/m^2]"""
    @cohesion.setter
    def cohesion(self, value: float) -> None: ...
    @property
    def normal_stiffness(self) -> float:
        """hooke [N/m]"""
    @normal_stiffness.setter
    def normal_stiffness(self, value: float) -> None: ...
    @property
    def shear_stiffness(self) -> float:
        """hooke [N/m]"""
    @shear_stiffness.setter
    def shear_stiffness(self, value: float) -> None: ...
    def __init__(self, restitution: float = ..., sliding_friction: float = ..., rolling_friction: float = ..., cohesion: float = ...) -> None: ...

class GrainNow:
    """Motion of a grain at a whole step."""
    @property
    def position(self) -> Array:
        """shape (3,), [m]"""
    @property
    def velocity(self) -> Array:
        """shape (3,), [m/s]"""
    @property
    def spin(self) -> Array:
        """shape (3,), [rad/s]"""
    @property
    def radius(self) -> float:
        """[m]"""

class Contact:
    """A contact as it is now."""
    @property
    def first(self) -> int:
        """id of a grain"""
    @property
    def second(self) -> int:
        """id of a grain, or -1 - index of a body"""
    @property
    def overlap(self) -> float:
        """[m]"""
    @property
    def pressing(self) -> float:
        """F_N [N]"""
    @property
    def point(self) -> Array:
        """shape (3,), [m]"""
    @property
    def normal(self) -> Array:
        """shape (3,), toward `first`"""
    @property
    def force(self) -> Array:
        """shape (3,), on `first` [N]"""
    @property
    def couple(self) -> Array:
        """shape (3,), on `first` [N m]"""

class EnergyBalance:
    """Where the energy is [J]."""
    @property
    def kinetic(self) -> float: ...
    @property
    def potential(self) -> float: ...
    @property
    def elastic(self) -> float:
        """of normal springs, cohesion included"""
    @property
    def tangential(self) -> float: ...
    @property
    def rolling(self) -> float: ...
    @property
    def damping(self) -> float:
        """lost in dashpots"""
    @property
    def into_slide(self) -> float:
        """taken by tangential springs, dashpots and sliders"""
    @property
    def into_roll(self) -> float: ...
    @property
    def total(self) -> float:
        """zero but for the error of the time step"""

class Simulation:
    """Spheres of one material and what they do to each other, step by step (docs/theory/dem-laws.md). One thread at a
    time: while it runs, other threads get a RuntimeError; its own progress may look at it.
    """
    @property
    def time(self) -> float:
        """[s]"""
    @property
    def dt(self) -> float:
        """[s]"""
    @property
    def rayleigh_time(self) -> float:
        """smallest over all grains [s]; a step is at most a fifth of it"""
    @property
    def positions(self) -> Array:
        """of all grains, in the order of their ids [m]; a copy: grains change their places in memory"""
    @property
    def velocities(self) -> Array:
        """[m/s]; a copy"""
    @property
    def radii(self) -> Array:
        """[m]; a copy"""
    def __init__(self, material: Material, interaction: Interaction, dt: float, gravity: Sequence[float] = ..., normal: NormalLaw = ..., rolling: RollingLaw = ..., cohesion: CohesionLaw = ..., threads: int = ...) -> None:
        """dt [s], gravity [m/s^2], threads 0: one a core or fewer (no number of them changes a bit). Raises InputError
        for what makes no sense.
        """
    def add_grain(self, position: Sequence[float], radius: float, velocity: Sequence[float] = ..., spin: Sequence[float] = ...) -> int:
        """[m], [m/s], [rad/s]; gives the grain's id."""
    def add_plane(self, point: Sequence[float], normal: Sequence[float]) -> int:
        """A plane that stands still, grains on the side of its normal."""
    def run(self, steps: int, progress: Optional[Told] = ...) -> None:
        """Raises RunStopped where an overlap is too deep or a grain is lost, InputError for a step that is too long.
        """
    def grain(self, id: int) -> GrainNow: ...
    def contacts(self) -> list[Contact]:
        """All contacts now, in a fixed order."""
    def energy(self) -> EnergyBalance:
        """What is where; see EnergyBalance."""

class PowerBalance:
    """Powers, means over the steady part [W]."""
    @property
    def drive(self) -> float:
        """M w"""
    @property
    def pull(self) -> float:
        """F_DP v"""
    @property
    def climb(self) -> float: ...
    @property
    def heave(self) -> float: ...
    @property
    def into_soil(self) -> float: ...
    @property
    def rest(self) -> float:
        """drive less all these"""

class Rut:
    """Change of the bed's surface, seen from above. Arrays are views."""
    @property
    def y(self) -> Array:
        """from the middle of the track to the left, shape (ny,) [m]"""
    @property
    def across(self) -> Array:
        """change of height at each y, shape (ny,) [m]"""
    @property
    def x(self) -> Array:
        """along the bin, shape (nx,) [m]"""
    @property
    def along(self) -> Array:
        """change of height at each x, shape (nx,) [m]"""
    @property
    def axle(self) -> float:
        """where the axle stood at the end [m]"""
    @property
    def volume(self) -> float:
        """[m^3] = heaped - dug"""
    @property
    def heaped(self) -> float:
        """[m^3]"""
    @property
    def dug(self) -> float:
        """[m^3]"""

class SoilFlow:
    """Mean velocity of the soil round the wheel in its middle plane; grids of nz x nx, views."""
    @property
    def cell(self) -> float:
        """side of a cell [m]"""
    @property
    def nx(self) -> int: ...
    @property
    def nz(self) -> int: ...
    @property
    def x(self) -> float:
        """lower corner of the first cell, from the axle [m]"""
    @property
    def z(self) -> float:
        """lower corner of the first cell, from the axle [m]"""
    @property
    def vx(self) -> Array:
        """forward [m/s]; NaN where no grain came"""
    @property
    def vz(self) -> Array:
        """upward [m/s]"""
    @property
    def solid(self) -> Array:
        """share of a cell that is grain [-]"""

class Run:
    """The steady-state mean of one independent run; None where a channel wasn't measured."""
    @property
    def at(self) -> OperatingCondition: ...
    @property
    def setpoint(self) -> Optional[str]:
        """runs with the same label are re-runs of one setpoint"""
    @property
    def drawbar_pull(self) -> Optional[float]:
        """[N]"""
    @property
    def torque(self) -> Optional[float]:
        """[N m]"""
    @property
    def sinkage(self) -> Optional[float]:
        """[m]"""
    @property
    def lateral_force(self) -> Optional[float]:
        """[N]"""
    @property
    def csv_line(self) -> int: ...

class Campaign:
    """What was measured, and what is known beforehand (docs/reference/campaigns.md)."""
    @property
    def name(self) -> str: ...
    @property
    def wheel(self) -> Tire: ...
    @property
    def soil(self) -> SemiEmpiricalSoil:
        """declared, with what plate and shear tests leave open"""
    @property
    def bin(self) -> Optional[Bin]: ...
    @property
    def effects(self) -> list[EffectChoice]:
        """declared"""
    @property
    def runs(self) -> list[Run]: ...
    def scenario(self) -> Scenario:
        """Wheel, declared soil and effects, for a model."""
    def doubts(self) -> list[str]:
        """What is possible, but hardly meant: sentences. No verdict of run_loop holds beside a column that looks
        mistaken.
        """

def find_campaign(name: str) -> Campaign:
    """A campaign of the library, its folder, or its campaign.yaml. Raises InputError with file, line and the nearest
    right word.
    """

class PredictedRun:
    """What was measured, and what the model says there."""
    @property
    def run(self) -> int: ...
    @property
    def measured(self) -> Run: ...
    @property
    def predicted(self) -> Answer: ...

class ChannelError:
    """How far a channel's predictions lie from the measurements [SI]."""
    @property
    def channel(self) -> str: ...
    @property
    def runs(self) -> int: ...
    @property
    def rmse(self) -> float: ...
    @property
    def bias(self) -> float:
        """mean of predicted less measured"""
    @property
    def range(self) -> float:
        """of the measured values"""
    @property
    def share_of_range(self) -> float:
        """rmse/range; NaN where the range is 0"""

class Prediction:
    """A campaign as a model predicts it, row by row, nothing fitted."""
    @property
    def runs(self) -> list[PredictedRun]: ...
    @property
    def errors(self) -> list[ChannelError]:
        """a channel that was measured each"""
    @property
    def unsolved(self) -> int:
        """runs to which the model has no solution"""

def predictions(model: Model, scenario: Scenario, campaign: Campaign, progress: Optional[Told] = ...) -> Prediction:
    """Predicts every run at its own load, slip, angles, ... with the scenario's soil and effects."""

class RecordedRun:
    """A run of the soil bin: a condition on one packing."""
    @property
    def answer(self) -> Answer: ...
    @property
    def packing(self) -> int:
        """seed of the bed"""
    @property
    def source(self) -> str:
        """state of the sources of the program that ran it"""
    @property
    def seconds(self) -> float:
        """that it took on the clock on the wall"""
    @property
    def steady(self) -> bool: ...
    @property
    def drift(self) -> float: ...
    @property
    def power(self) -> PowerBalance: ...
    @property
    def rut(self) -> Rut: ...
    @property
    def flow(self) -> SoilFlow: ...

class Record:
    """What a soilbin-recorded/1 file holds (docs/guide/recorded.md)."""
    @property
    def soilbin(self) -> str:
        """version that began it"""
    @property
    def model(self) -> str: ...
    @property
    def inputs(self) -> list[tuple[str, str]]:
        """names and values that an answer follows from"""
    @property
    def runs(self) -> list[RecordedRun]: ...
    def case(self) -> Case:
        """The resolved question; of its conditions some may not have been run."""

class RecordedModel(Model):
    """Answers from a record alone: means over packings. The scenario isn't looked at."""
    @property
    def record(self) -> Record: ...
    def __init__(self, record: Record) -> None: ...

def tell_campaign(records: Sequence[Record], hide: Sequence[str] = ..., effects: Sequence[Union[EffectChoice, str]] = ..., soil: Optional[Soil] = ..., name: str = ..., only_steady: bool = ..., seed: int = ...) -> Campaign:
    """Runs as a measured campaign: soilbin.compare.tell_campaign tells the arguments."""

def write_campaign(campaign: Campaign, folder: Union[str, PathLike[str]]) -> None:
    """Writes campaign.yaml and its data into a folder, made where it is missing; find_campaign reads it back."""

def read_record(path: Union[str, PathLike[str]]) -> Record:
    """Reads a record. Raises InputError with file and place for everything that is none."""

class WheelRun:
    """What a run of the soil bin tells."""
    @property
    def result(self) -> TractionResult: ...
    @property
    def power(self) -> PowerBalance: ...
    @property
    def steady(self) -> bool:
        """whether the run became steady (docs/theory/soil-bin.md)"""
    @property
    def drift(self) -> float:
        """largest difference of halves over its standard error"""
    @property
    def steady_from(self) -> int:
        """first sample that counts"""
    @property
    def rut(self) -> Rut: ...
    @property
    def flow(self) -> SoilFlow: ...
    @property
    def samples(self) -> dict[str, Array]:
        """arrays of one shape (samples,) from the start of the motion on, views: time [s], travel, sinkage [m], force
        [N] and moment [N m] of the soil on the wheel (three columns), ...
        """

class SoilBin:
    """A virtual soil bin: a case's tire over a settled bed of its grains. Keeps its beds."""
    def __init__(self, packing: int = ..., beds: Optional[Union[str, PathLike[str]]] = ..., ledger: bool = ..., threads: int = ..., **parameters: float) -> None:
        """packing: seed of the bed. beds: folder that keeps settled beds, and runs that are stopped, which then go on; None: neither is kept. ledger: tells where the power goes. threads: 0, one a core or fewer; changes no bit. By keywords:
          length: of the bed [m]
          width: of the bed [m]; a scenario's bin replaces it
          depth: of the bed [m]; a scenario's bin replaces it
          settling_friction: share of friction while the bed settles [-], 0 (densest) .. 1 (loose)
          behind: of the axle to the rear end, at the start [m]
          ahead: of the axle to the front end, at the end [m]
          travel: of the axle [m]; 0: as far as the bin lets it
          lowering: time in which the load comes on [s]
          resting: time under the load before the start [s]
          starting: time in which the motion comes on [s]
          dt: [s]; 0: a fifth of the Rayleigh time
          deepest_overlap: of the smaller radius that grains may overlap [-]
        """
    def run(self, scenario: Scenario, at: OperatingCondition, progress: Optional[Told] = ...) -> WheelRun:
        """One run. progress: called with (share done, stage). Raises InputError for a bed too small and for what grains
        can't do (effects, a second pass), NoSolution where the wheel digs itself in, RunStopped.
        """
    def record(self, case: Case, file: Union[str, PathLike[str]], packings: int = ..., progress: Optional[Told] = ..., half_step: bool = ...) -> Record:
        """Runs the conditions of a case's study, each on so many packings from the bin's on, and keeps each run in the
        file as it is finished; what is there isn't run again. half_step: first the hardest condition also at half the
        time step, as soilbin run --half-step yes does. Gives the record. What grains can't answer is a run with its
        error. Raises InputError for a file of other inputs, which it names, and RuntimeError where the half step's
        answer differs.
        """
    def inputs(self, scenario: Scenario) -> list[tuple[str, str]]:
        """Everything that a run follows from beside condition and packing, as names and values."""

class StrengthLine:
    """tau = c + sigma tan(phi), fitted."""
    @property
    def cohesion(self) -> Estimate:
        """c [Pa]; may come out below 0"""
    @property
    def friction_angle(self) -> Estimate:
        """phi [rad]"""
    @property
    def covariance(self) -> float:
        """of c and phi [Pa rad]"""
    @property
    def chi2(self) -> float: ...
    @property
    def points(self) -> int: ...
    @property
    def friction_angle_without_cohesion(self) -> Estimate:
        """of the line through the origin [rad]"""

class DirectShearRun:
    """One specimen under one stress."""
    @property
    def stress(self) -> float:
        """asked of the lid [Pa]"""
    @property
    def packing(self) -> int:
        """seed"""
    @property
    def void_ratio(self) -> float:
        """before the shear [-]"""
    @property
    def peak(self) -> Estimate:
        """shear over normal stress [-]"""
    @property
    def residual(self) -> Estimate:
        """shear over normal stress [-]"""
    @property
    def peak_at(self) -> float:
        """displacement [m]"""
    @property
    def work(self) -> float:
        """done on the grains by lid and box [J]"""
    @property
    def work_of_stress(self) -> float:
        """the same by the curve's stresses [J]"""
    @property
    def curve(self) -> dict[str, Array]:
        """arrays of one shape (samples,), views: displacement, dilation [m], shear_stress, normal_stress [Pa]"""

class DirectShearResult:
    """The shear box's answer."""
    @property
    def runs(self) -> list[DirectShearRun]: ...
    @property
    def peak(self) -> StrengthLine:
        """points 0 with a single stress"""
    @property
    def residual(self) -> StrengthLine: ...
    @property
    def mean_diameter(self) -> float:
        """[m]"""

def direct_shear(soil: GranularSoil, stresses: Sequence[float] = ..., packings: int = ..., packing: int = ..., length: float = ..., width: float = ..., height: float = ..., travel: float = ..., settling_friction: float = ..., rolling: RollingLaw = ..., inertial: float = ..., threads: int = ..., progress: Optional[Told] = ...) -> DirectShearResult:
    """The shear box (docs/guide/element-tests.md). stresses: normal, on the lid [Pa], at least two for c and phi.
    packings: specimens, of seeds packing, +1, ... length, width, height, travel: in mean diameters.
    settling_friction: 0 (densest) .. 1 (loose). inertial: number that sets the speed. Same settings, same bits, for
    any number of threads. Raises InputError, RunStopped.
    """

class AngleOfReposeResult:
    """A heap at rest."""
    @property
    def angle(self) -> Estimate:
        """of the slope [rad]"""
    @property
    def by_sector(self) -> list[float]:
        """[rad]"""
    @property
    def height(self) -> float:
        """of the heap [m]"""
    @property
    def base(self) -> float:
        """its radius where the fitted line meets the floor [m]"""
    @property
    def grains(self) -> int: ...
    @property
    def settling_time(self) -> float:
        """from the start of the lift until rest [s]"""
    @property
    def mean_diameter(self) -> float:
        """[m]"""
    @property
    def profile(self) -> dict[str, Array]:
        """arrays of one shape (rings,), views: radius, height [m]"""

def angle_of_repose(soil: GranularSoil, packing: int = ..., radius: float = ..., height: float = ..., rolling: RollingLaw = ..., threads: int = ..., progress: Optional[Told] = ...) -> AngleOfReposeResult:
    """A cylinder of grains (radius and height in mean diameters) on a floor is lifted; the heap's slope, with its error
    by eight sectors. Raises InputError, RunStopped where no rest is found.
    """

class TriaxialRun:
    """One specimen under one confining stress."""
    @property
    def stress(self) -> float:
        """confining [Pa]"""
    @property
    def packing(self) -> int:
        """seed"""
    @property
    def void_ratio(self) -> float:
        """after isotropic consolidation [-]"""
    @property
    def isotropic_error(self) -> float:
        """after it, largest |stress/asked - 1| of the axes [-]"""
    @property
    def confining_error(self) -> float:
        """during compression, of the mean lateral stresses [-]"""
    @property
    def peak(self) -> Estimate:
        """(s1 - s3)/(s1 + s3), the sine of the mobilised angle [-]"""
    @property
    def residual(self) -> Estimate:
        """the same at the end [-]"""
    @property
    def peak_at(self) -> float:
        """axial strain [-]"""
    @property
    def dilation_angle(self) -> float:
        """at the peak [rad]"""
    @property
    def work(self) -> float:
        """of the walls on the grains during compression [J]"""
    @property
    def curve(self) -> dict[str, Array]:
        """arrays of one shape (samples,), views: strain, volumetric (compression positive) [-], axial, lateral_x,
        lateral_y [Pa]
        """

class TriaxialResult:
    """The triaxial cell's answer."""
    @property
    def runs(self) -> list[TriaxialRun]: ...
    @property
    def peak(self) -> StrengthLine:
        """points 0 with a single stress"""
    @property
    def residual(self) -> StrengthLine: ...
    @property
    def mean_diameter(self) -> float:
        """[m]"""

def triaxial(soil: GranularSoil, stresses: Sequence[float] = ..., packings: int = ..., packing: int = ..., side: float = ..., height: float = ..., strain: float = ..., settling_friction: float = ..., rolling: RollingLaw = ..., inertial: float = ..., threads: int = ..., progress: Optional[Told] = ...) -> TriaxialResult:
    """True triaxial compression between six smooth walls (docs/guide/element-tests.md). stresses: confining [Pa], at
    least two for c and phi. side, height: of the specimen, in mean diameters. strain: axial, at the end. inertial:
    number that sets the rate. Raises InputError, RunStopped.
    """

class TiltingBoardResult:
    """A layer of grains on a board that was tilted."""
    @property
    def onset(self) -> float:
        """angle at which it began to slide [rad]"""
    @property
    def gone(self) -> float:
        """angle at which it had slid by a diameter [rad]"""
    @property
    def slid(self) -> bool:
        """False: it held up to the steepest angle, and both angles are that"""
    @property
    def grains(self) -> int: ...
    @property
    def mean_diameter(self) -> float:
        """[m]"""
    @property
    def curve(self) -> dict[str, Array]:
        """arrays of one shape (samples,), views: angle [rad], slide down the board [m], turn: how far grains rolled
        [rad]
        """

def tilting_board(soil: GranularSoil, packing: int = ..., across: int = ..., layers: float = ..., dt: float = ..., rolling: RollingLaw = ..., threads: int = ..., progress: Optional[Told] = ...) -> TiltingBoardResult:
    """The friction test of Zhou, Gao, Li, Hu: sand on a board of the tire's material, tilted until it slides. across:
    grains along a side. layers: height in mean diameters. dt: time step [s]; 0: the longest that is safe, at which
    directional rolling resistance lets grains creep. Raises InputError, RunStopped.
    """

class PlateRun:
    """One plate pressed into the bed."""
    @property
    def diameter(self) -> float:
        """[m]"""
    @property
    def speed(self) -> float:
        """[m/s]"""
    @property
    def grains(self) -> int:
        """in the bed"""
    @property
    def void_ratio(self) -> float:
        """of the bed [-]"""
    @property
    def density(self) -> float:
        """of the bed in bulk [kg/m^3]"""
    @property
    def packing(self) -> int:
        """seed"""
    @property
    def curve(self) -> dict[str, Array]:
        """arrays of one shape (samples,), views: sinkage [m], pressure [Pa]"""

class AnnulusRun:
    """The ring turned under one stress."""
    @property
    def stress(self) -> float:
        """asked for [Pa]"""
    @property
    def speed(self) -> float:
        """at the mean radius [m/s]"""
    @property
    def packing(self) -> int:
        """seed"""
    @property
    def curve(self) -> dict[str, Array]:
        """arrays of one shape (samples,), views: displacement, sinkage [m], shear_stress, normal_stress [Pa]"""

def plate_sinkage(soil: GranularSoil, diameters: Sequence[float] = ..., sinkage: float = ..., width: float = ..., depth: float = ..., packing: int = ..., settling_friction: float = ..., rolling: RollingLaw = ..., threads: int = ..., progress: Optional[Told] = ...) -> list[PlateRun]:
    """Round plates pressed into a bed of the grains, each into a fresh copy (docs/guide/element-tests.md). diameters,
    sinkage: in mean diameters of the grains. width, depth: of the bed, in diameters of the widest plate. Raises
    InputError for a plate under five grains wide, RunStopped.
    """

def annular_shear(soil: GranularSoil, stresses: Sequence[float] = ..., inner: float = ..., outer: float = ..., travel: float = ..., width: float = ..., depth: float = ..., packing: int = ..., settling_friction: float = ..., rolling: RollingLaw = ..., threads: int = ..., progress: Optional[Told] = ...) -> list[AnnulusRun]:
    """A ring with grousers turned on a bed of the grains under each stress [Pa] (docs/guide/element-tests.md). inner,
    outer: its radii; travel: at the mean radius; all in mean diameters. width, depth: of the bed, in diameters of the
    ring. Raises InputError for a ring under five grains wide, RunStopped.
    """

class Verdict:
    """What the loop says."""
    effect_found: ClassVar[Verdict]
    nothing_missing: ClassVar[Verdict]
    unknown_effect: ClassVar[Verdict]
    not_enough_data: ClassVar[Verdict]
    def __init__(self, value: int) -> None: ...
    def __int__(self) -> int: ...
    @property
    def name(self) -> str: ...
    @property
    def value(self) -> int: ...

class AcceptedEffect:
    """An effect that the loop accepts, in the form that fits best."""
    @property
    def choice(self) -> EffectChoice:
        """with fitted parameters [SI]"""
    @property
    def fitted(self) -> list[str]:
        """names of the parameters that were fitted"""
    @property
    def ci95(self) -> list[tuple[float, float]]:
        """of each fitted parameter, cut off at its bounds"""
    @property
    def at_bound(self) -> list[bool]:
        """of each: the fit ended at a bound"""
    @property
    def p_value(self) -> float:
        """family-wise, beside the other accepted effects"""
    @property
    def cosines(self) -> dict[str, float]:
        """of its trace with each other effect's"""

class Weighted:
    """A set of effects with its share of the evidence."""
    @property
    def ids(self) -> set[str]: ...
    @property
    def weight(self) -> float: ...

class LackOfFit:
    """Residual mean square over the noise's, as an F test."""
    @property
    def f(self) -> float: ...
    @property
    def freedom(self) -> float: ...
    @property
    def noise_freedom(self) -> float: ...
    @property
    def p_value(self) -> float: ...

class NextTest:
    """The run to make next."""
    @property
    def at(self) -> OperatingCondition: ...
    @property
    def quantities(self) -> list[str]: ...
    @property
    def separates(self) -> list[set[str]]: ...
    @property
    def runs(self) -> int: ...

class LoopAnswer:
    """The loop's answer (docs/guide/loop.md)."""
    @property
    def campaign(self) -> str: ...
    @property
    def verdict(self) -> Verdict: ...
    @property
    def reason(self) -> str:
        """one plain sentence"""
    @property
    def effects(self) -> list[AcceptedEffect]: ...
    @property
    def stand_in(self) -> list[AcceptedEffect]:
        """of an unknown effect: the best named ones, where they predict held-out conditions better; they explain nothing
        """
    @property
    def ambiguity_set(self) -> list[Weighted]:
        """best first; empty unless effects compete"""
    @property
    def not_testable(self) -> list[str]: ...
    @property
    def next(self) -> Optional[NextTest]: ...
    @property
    def before(self) -> LackOfFit: ...
    @property
    def after(self) -> LackOfFit: ...
    @property
    def soil(self) -> SemiEmpiricalSoil:
        """refitted with the accepted effects, with standard errors"""
    @property
    def outliers(self) -> int:
        """number of values set aside"""
    @property
    def weights(self) -> list[Weighted]:
        """over sets of effects, best first"""
    @property
    def held_out(self) -> dict[str, dict[str, float]]:
        """root mean square errors on conditions that neither choice nor fit has seen, by channel [SI] and 'all' [sigma]:
        cells, before, after, noise_floor; empty without validation
        """
    @property
    def worse(self) -> list[str]:
        """channels whose held-out error is larger with the effects of the model than without; empty for a model without
        effects and without validation
        """
    @property
    def presumes(self) -> dict[str, list[Presumed]]:
        """of each effect of the model, by id: what it takes for values that the campaign's wheel does not declare (lugs,
        inflation pressure); an empty list where it presumes nothing
        """
    @property
    def sentences(self) -> list[str]:
        """the verdict and what stands behind it, in plain words"""
    def json(self) -> str:
        """soilbin-loop/1"""
    def resolved_model(self, campaign: Campaign) -> Case:
        """The campaign's wheel on the refitted soil with the accepted effects, as a Case."""

def run_loop(campaign: Campaign, folds: int = ..., seed: int = ..., validate: bool = ..., threads: int = ..., progress: Optional[Told] = ...) -> LoopAnswer:
    """Residual, cause, effect added, error before and after. validate: the whole procedure redone in each fold, for
    honest errors; without it they are absent. threads change the time, never the answer. Raises InputError for a
    campaign that can't be used; one too small to say anything is a verdict.
    """

class SideKind:
    """Where a side's numbers come from."""
    analytic: ClassVar[SideKind]
    grains: ClassVar[SideKind]
    measured: ClassVar[SideKind]
    def __init__(self, value: int) -> None: ...
    def __int__(self) -> int: ...
    @property
    def name(self) -> str: ...
    @property
    def value(self) -> int: ...

class Side:
    """A model or the measurement, a point for each condition of a study."""
    @property
    def label(self) -> str: ...
    @property
    def kind(self) -> SideKind: ...
    @property
    def results(self) -> list[Optional[TractionResult]]:
        """a result, or None, for each condition"""

class Finding:
    """What can be said of a difference (docs/theory/comparing.md)."""
    difference: ClassVar[Finding]
    within_scatter: ClassVar[Finding]
    within_errors: ClassVar[Finding]
    not_judged: ClassVar[Finding]
    def __init__(self, value: int) -> None: ...
    def __int__(self) -> int: ...
    @property
    def name(self) -> str: ...
    @property
    def value(self) -> int: ...

class Difference:
    """One side against another, one channel, one condition [SI]."""
    @property
    def side(self) -> int:
        """of Comparison.sides"""
    @property
    def reference(self) -> int:
        """of Comparison.sides"""
    @property
    def condition(self) -> int:
        """of the study"""
    @property
    def channel(self) -> str: ...
    @property
    def value(self) -> Estimate: ...
    @property
    def reference_value(self) -> Estimate: ...
    @property
    def scatter(self) -> float:
        """of one run of the reference"""
    @property
    def difference(self) -> float:
        """value less reference value"""
    @property
    def std_error(self) -> float: ...
    @property
    def freedom(self) -> float:
        """degrees of freedom behind the standard error; infinite where it is known"""
    @property
    def share(self) -> float:
        """of the load: forces over W, torque over W r, sinkage over r"""
    @property
    def finding(self) -> Finding: ...

class Comparison:
    """Models and measurements side by side."""
    @property
    def case(self) -> Case: ...
    @property
    def sides(self) -> list[Side]:
        """analytic first, then grains, then measured"""
    @property
    def differences(self) -> list[Difference]:
        """by pair, channel, condition"""
    @property
    def not_compared(self) -> list[str]: ...
    @property
    def sentences(self) -> list[str]:
        """the comparison in plain words"""

def compare_case(case: Case, effects: Sequence[Union[EffectChoice, str]] = ..., runs: Sequence[RecordedRun] = ..., measured: Optional[Campaign] = ...) -> Comparison:
    """Sides of a study: its analytic models and the base model with each of `effects`; runs of grains, of a record; a
    campaign of the same wheel. Raises InputError where wheels or conditions don't meet.
    """

class CalibrationRun:
    """One experiment of a calibration. SI."""
    @property
    def stage(self) -> str:
        """'design', 'candidates' or 'refinement'"""
    @property
    def seed(self) -> int:
        """of its packings"""
    @property
    def values(self) -> dict[str, float]:
        """of the factors"""
    @property
    def results(self) -> dict[str, Estimate]:
        """of the targets; empty where it failed"""
    @property
    def error(self) -> str:
        """why it failed"""
    @property
    def seconds(self) -> float:
        """that it took on the clock on the wall"""
    @property
    def from_store(self) -> bool:
        """whether it had been made before"""

class CalibrationCandidate:
    """A point between the bounds, and what is known of it. SI."""
    @property
    def values(self) -> dict[str, float]:
        """of the factors"""
    @property
    def predicted(self) -> dict[str, Estimate]:
        """of the targets, by the surrogates of all runs"""
    @property
    def chi_square(self) -> float:
        """sum over targets of (predicted - measured)^2/(both errors squared)"""
    @property
    def chance(self) -> float:
        """that every target is met within the share asked for [-]"""
    @property
    def runs(self) -> int:
        """made at this very point"""

class VarianceRow:
    """A factor in the analyses of an orthogonal design; or what none explains."""
    @property
    def source(self) -> str:
        """the factor's name"""
    @property
    def range(self) -> float:
        """R: largest level mean less smallest [SI]; NaN of what is left"""
    @property
    def level_means(self) -> list[float]:
        """k_i: mean of the runs at each level [SI]"""
    @property
    def sum_of_squares(self) -> float:
        """about the mean [SI, squared]"""
    @property
    def freedom(self) -> int:
        """degrees of it"""
    @property
    def mean_square(self) -> float:
        """[SI, squared]"""
    @property
    def f(self) -> float:
        """mean square over the error's; NaN where it is the error"""
    @property
    def p_value(self) -> float:
        """of so large an F by chance; NaN as f"""
    @property
    def pooled(self) -> bool:
        """whether it was taken for error"""

class Calibration:
    """What a calibration found (docs/theory/calibration.md). SI; by names of factors, targets."""
    @property
    def targets(self) -> dict[str, Estimate]:
        """what was to be reached"""
    @property
    def factors(self) -> dict[str, tuple[float, float]]:
        """lower and upper bound of what was varied"""
    @property
    def runs(self) -> list[CalibrationRun]:
        """every experiment, in order"""
    @property
    def variance(self) -> dict[str, list[VarianceRow]]:
        """of each target, the orthogonal design's range analysis and analysis of variance; empty where a run of the
        design failed
        """
    @property
    def left_out(self) -> dict[str, dict[str, Array]]:
        """of each target, the surrogate at each run from all others, arrays: residual, sd [SI], standardised [-]
        """
    @property
    def candidates(self) -> list[CalibrationCandidate]:
        """run, and predicted near every target, the likeliest first"""
    @property
    def best(self) -> CalibrationCandidate:
        """the one that is chosen"""
    @property
    def reached(self) -> bool:
        """whether best's chance is at least the probability asked for"""
    @property
    def parameters(self) -> dict[str, Estimate]:
        """of the factors, given the targets and a flat prior between the bounds"""
    @property
    def told(self) -> dict[str, float]:
        """1 - sd of parameters over that of the flat prior; 0: the test says nothing of it [-]"""
    @property
    def sentences(self) -> list[str]:
        """the verdict and what stands behind it, in plain words"""
    def soil(self) -> Soil:
        """The soil with best's values in the contact; its sources say where they come from."""
    def json(self) -> str:
        """soilbin-calibration/1"""

def calibrate(soil: Soil, contact: str = ..., targets: Optional[dict[str, Union[Estimate, float]]] = ..., vary: dict[str, tuple[float, float]] = ..., keep: Sequence[str] = ..., design: str = ..., runs: int = ..., near: float = ..., within: float = ..., probability: float = ..., strength: str = ..., stresses: Sequence[float] = ..., settling_friction: float = ..., across: int = ..., packings: int = ..., seed: int = ..., store: Optional[Union[str, PathLike[str]]] = ..., threads: int = ..., progress: Optional[Told] = ...) -> Calibration:
    """Contacts of grains from virtual tests: soilbin.compare.calibrate tells the arguments. Raises InputError for a
    question that makes no sense, NoSolution where too many experiments fail to learn from the rest.
    """

