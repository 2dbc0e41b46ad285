export {
  WebGLRenderer, Scene, PerspectiveCamera, Mesh, BufferGeometry, BufferAttribute, Color, Vector2, Vector3, Box3, Sphere,
  MeshStandardMaterial, MeshBasicMaterial, HemisphereLight, DirectionalLight, DoubleSide, FrontSide, DataTexture, RGBAFormat,
  UnsignedByteType, LinearFilter, Plane, Raycaster, GridHelper, SphereGeometry, SRGBColorSpace,
} from 'three';
export { OrbitControls } from 'three/examples/jsm/controls/OrbitControls.js';
